#include "seacrane/dynamics/terms.hpp"
#include "seacrane/elements/loads/spring_damper.hpp"
#include "seacrane/run/channels/channel.hpp"

namespace seacrane {
namespace {

const Axis spring{"spring", {}, [](const Model& m) {
                    std::vector<std::string> names;
                    for (const auto& d : m.description.loads.of<SpringDamper>()) names.push_back(d.name);
                    return names;
                  }};

void write_spring_length(const Output& o, double* out) {
  const LoadInput<double> in = o.terms.load_input(o.time, o.state + o.terms.model().layout.memory);
  for (const SpringDamper& one : o.terms.model().loads.of<SpringDamper>()) {
    *out++ = one.span.length(in);
  }
}

}  // namespace

std::vector<Channel> spring_channels() {
  return {
      {.name = "spring_length",
       .axes = {&spring},
       .unit = "m",
       .text = "distance between the ends of the spring",
       .by_default = false,
       .write = write_spring_length},
  };
}

}  // namespace seacrane
