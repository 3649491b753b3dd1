#pragma once

#include <complex>

namespace seacrane::strip {

using Complex = std::complex<double>;
inline constexpr Complex i_unit{0.0, 1.0};

}  // namespace seacrane::strip
