#include "seacrane/strip/strip_theory.hpp"

#include <stdexcept>

namespace seacrane::strip {

StripResult strip_theory(const StripCase&, const std::function<void()>&) {
  throw std::runtime_error("strip_theory is not finished yet");
}

SectionRadiation section_radiation(const HalfSection&, const std::vector<double>&, const SectionSettings&,
                                   const std::function<void()>&) {
  throw std::runtime_error("section_radiation is not finished yet");
}

}  // namespace seacrane::strip
