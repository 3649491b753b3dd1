#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace seacrane {

/// The integration cannot continue. Thrown in place of a NaN, a hang or a message on the terminal.
class IntegrationError : public std::runtime_error {
 public:
  static constexpr std::size_t no_component = static_cast<std::size_t>(-1);

  IntegrationError(std::string method, double time, double step_size, std::size_t component,
                   std::string reason);

  const std::string& method() const { return method_; }
  double time() const { return time_; }
  double step_size() const { return step_size_; }
  /// Index of the state component with the largest weighted error (or the first non-finite one).
  std::size_t component() const { return component_; }
  const std::string& reason() const { return reason_; }

 private:
  std::string method_;
  double time_;
  double step_size_;
  std::size_t component_;
  std::string reason_;
};

}  // namespace seacrane
