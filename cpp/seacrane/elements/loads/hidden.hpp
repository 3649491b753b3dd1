#pragma once

#include <memory>

namespace seacrane {

/// The lists of all described and of all compiled loads, in registry.hpp.
struct LoadDescriptions;
struct CompiledLoads;

/// A value whose type is complete only where it is used, so that what uses no loads does not depend on the
/// list of them.
template <class T>
class Hidden {
 public:
  Hidden();
  Hidden(const Hidden& other);
  Hidden(Hidden&& other) noexcept;
  Hidden& operator=(Hidden other) noexcept;
  ~Hidden();

  T& operator*() { return *value_; }
  const T& operator*() const { return *value_; }

 private:
  std::unique_ptr<T> value_;
};

extern template class Hidden<LoadDescriptions>;
extern template class Hidden<CompiledLoads>;

}  // namespace seacrane
