#pragma once

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

namespace seacrane::sea {

/// Throws std::invalid_argument "<object>: <name> is <value>; <fix>" unless `valid`.
template <class Value>
void require(bool valid, const std::string& object, const std::string& name, const Value& value,
             const std::string& fix) {
  if (valid) return;
  std::ostringstream text;
  text.precision(10);
  text << object << ": " << name << " is " << value << "; " << fix;
  throw std::invalid_argument(text.str());
}

/// "(a, b)".
template <class Value>
std::string pair_text(const Value& a, const Value& b) {
  std::ostringstream text;
  text << '(' << a << ", " << b << ')';
  return text.str();
}

inline void require_positive(double value, const std::string& object, const std::string& name,
                             const std::string& unit) {
  require(std::isfinite(value) && value > 0.0, object, name, value,
          "give a finite value above zero" + (unit.empty() ? "" : " in " + unit));
}

inline void require_finite(double value, const std::string& object, const std::string& name,
                           const std::string& unit) {
  require(std::isfinite(value), object, name, value, "give a finite value in " + unit);
}

}  // namespace seacrane::sea
