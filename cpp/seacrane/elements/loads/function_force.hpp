#pragma once

#include <array>
#include <string>
#include <type_traits>
#include <vector>

#include "seacrane/elements/field.hpp"
#include "seacrane/elements/loads/load.hpp"
#include "seacrane/math/rotation.hpp"

namespace seacrane {

/// void f(double t, const double state[13], const double* parameters, double wrench[6]):
/// state = position, quaternion, velocity, angular velocity of the body origin; wrench about it, inertial
/// axes.
using ForceFunction = void (*)(double, const double*, const double*, double*);

struct FunctionForceDescription {
  std::string name, body;
  ForceFunction function = nullptr;
  std::vector<double> parameters;

  static constexpr const char* type = "FunctionForce";
  static constexpr const char* text =
      "A C function called in every evaluation, by its address (numba.cfunc(...).address): void "
      "f(double t, const double* state13, const double* parameters, double* wrench6); state: position, "
      "quaternion, velocity, angular velocity of the body origin; inertial axes.";
  static constexpr auto fields() {
    using D = FunctionForceDescription;
    return std::tuple(on_body("body", &D::body), required("address", &D::function, "", "of the C function"),
                      optional("parameters", &D::parameters, "", "handed to the function"));
  }
};

/// A user's C function called in every evaluation, see ForceFunction.
struct FunctionForce {
  static constexpr const char* kind = "function force";
  static constexpr bool by_differences = true;  // apply() knows doubles alone, and one body
  static constexpr bool own_pace = true;        // of a frequency that nobody knows
  using Description = FunctionForceDescription;

  Description d;
  int body = 0;
  Vec3d origin;  // body origin from the state point, body axes
  Mat3d axes;    // of the described body

  static void check(const Description& d, const Check& c, SceneNames& names) {
    names.body(c, d.body);
    if (d.function == nullptr) c.fail("the function's address is 0; pass a C function pointer");
  }

  static Description example() {
    const ForceFunction pull = [](double, const double* state, const double* parameters, double* wrench) {
      for (int i = 0; i < 3; ++i) {
        wrench[i] = -state[i] * state[i] * state[i] - parameters[0] * state[7 + i];
        wrench[3 + i] = state[4 + i] - 0.3 * state[10 + i];
      }
    };
    return {"load", "second", pull, {0.7}};
  }

  template <class Context>
  static FunctionForce compile(const Description& d, Context& context) {
    const Attachment on = context.attach(d.body, Vec3d::Zero());
    return {d, on.body, on.point, on.axes};
  }

  /// What the function makes of time is not known.
  static std::vector<LoadKinks> kinks() { return {}; }

  std::array<int, 1> bodies() const { return {body}; }

  template <class T>
  void apply(const LoadInput<T>& in, LoadSum<T>& out) const {
    static_assert(std::is_same_v<T, double>, "a C function knows no other scalar");
    const auto& k = in.bodies[body];
    const Vec3d lever = k.rotation * origin;
    const Vec3d velocity = k.velocity + k.angular_velocity.cross(lever);
    double state[13], wrench[6] = {};
    view<3>(state) = k.position + lever;
    view<4>(state + 3) = quaternion_from_rotation(Mat3d(k.rotation * axes));
    view<3>(state + 7) = velocity;
    view<3>(state + 10) = k.angular_velocity;
    d.function(in.time, state, d.parameters.data(), wrench);
    const Vec3d force = view<3>(wrench), moment = view<3>(wrench + 3);
    out.wrench[body].add(force, lever);
    out.wrench[body].moment += moment;
    out.add_power(force.dot(velocity) + moment.dot(k.angular_velocity));
  }
};

}  // namespace seacrane
