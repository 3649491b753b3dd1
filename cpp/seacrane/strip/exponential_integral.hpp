#pragma once

#include <complex>

namespace seacrane::strip {

/// exp(-w) Ei(w) for Re w >= 0, w != 0, to an absolute error of 1e-8, given exp(-w) and ln w, which callers
/// have as a product and as a sum of known terms. Ei is continued from the positive real axis: Ei(w) =
/// -E1(-w) + i pi sign(Im w) (Abramowitz and Stegun, 5.1.1 and 5.1.7).
std::complex<double> decaying_exponential_integral(std::complex<double> w, std::complex<double> exp_minus_w,
                                                   std::complex<double> log_w);

}  // namespace seacrane::strip
