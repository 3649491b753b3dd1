#include "seacrane/compile/start_contacts.hpp"

#include <memory>
#include <optional>
#include <string>

#include "seacrane/dynamics/terms.hpp"
#include "seacrane/elements/check.hpp"
#include "seacrane/elements/loads/contact.hpp"

namespace seacrane {
namespace {

constexpr double kDeep = 0.1;      // m, that a point of a contact may start inside
constexpr double kCrushed = 10.0;  // times its share of the weight, with which it may be pressed there

void check_depth(const Contact& contact, std::size_t point, const LoadInput<double>& in, const Model& model) {
  const Contact::Touch<double> now = contact.touch(in, point);
  const int of = contact.body < model.body_count() ? contact.body : contact.on;
  const double weight = model.bodies[idx(of)].mass * model.description.gravity,
               share = weight / static_cast<double>(contact.points.size());
  if (-now.gap <= kDeep || now.press.elastic <= kCrushed * share) return;
  throw SceneError("contact '" + contact.d.name + "': point " + std::to_string(point + 1) + " of '" +
                   contact.d.body + "' starts " + to_text(-now.gap) + " m inside '" + contact.d.on +
                   "', where it is pressed out with " + to_text(now.press.elastic) +
                   " N; move the body out, turn the axis of the surface, or correct its place");
}

}  // namespace

void start_contacts(Model& model) {
  if (model.loads.find<Contact>() == nullptr) return;
  const std::shared_ptr<const Model> view(&model, [](const Model*) {});
  Terms terms(view);
  double* const y = model.initial_state.data();
  terms.read(0.0, y);
  const LoadInput<double> in = terms.load_input(0.0, y + model.layout.memory);
  for (const Contact& one : model.loads.of<Contact>()) {
    for (std::size_t i = 0; i < one.points.size(); ++i) check_depth(one, i, in, model);
    one.take_anchors(in, std::nullopt, y + model.layout.loads);
  }
}

}  // namespace seacrane
