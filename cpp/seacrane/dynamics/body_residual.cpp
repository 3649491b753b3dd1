#include "seacrane/dynamics/body_residual.hpp"

#include <algorithm>

#include "seacrane/dynamics/jacobian.hpp"
#include "seacrane/dynamics/terms.hpp"
#include "seacrane/elements/driver.hpp"
#include "seacrane/elements/joints/joint_kinds.hpp"

namespace seacrane {
namespace {

/// Step of the central differences of a function force, m, rad and per s: error about 1e-10 of its scale.
constexpr double kStep = 1e-5;

template <class T>
BodyKinematics<T> constant(const BodyKinematics<double>& k) {
  return {k.position.cast<T>(), k.rotation.cast<T>(), k.velocity.cast<T>(), k.angular_velocity.cast<T>()};
}

BodyKinematics<double> moved(const BodyKinematics<double>& k, int direction, double step) {
  const Vec3d along = step * Vec3d::Unit(direction % 3);
  BodyKinematics<double> out = k;
  if (direction < 3) {
    out.position += along;
  } else if (direction < 6) {
    out.rotation = Eigen::AngleAxisd(step, Vec3d::Unit(direction % 3)) * k.rotation;
  } else if (direction < 9) {
    out.velocity += along;
  } else {
    out.angular_velocity += along;
  }
  return out;
}

}  // namespace

BodyResidual::BodyResidual(const Model& model, const std::vector<int>* counted)
    : model_(&model),
      counted_(model.elements.size(), counted == nullptr),
      bodies_(idx(model.body_count()) + 1),
      moved_(bodies_.size()),
      wrench_(bodies_.size()),
      second_wrench_(bodies_.size()),
      moved_wrench_(bodies_.size()),
      right_(idx(model.rows())),
      rate_(right_.size()),
      position_(right_.size()) {
  if (counted) {
    for (int e : *counted) counted_[idx(e)] = true;
  }
  int most = 0;
  for (const Vessel& vessel : model.vessels) most = std::max(most, vessel.memory_states());
  memory_rate_.resize(idx(most));
  for (const HydroGroup& group : model.groups) {
    group_rate_.resize(std::max(group_rate_.size(), idx(group.memory.states())));
  }
  memory_state_.resize(std::max(memory_rate_.size(), group_rate_.size()));
  if (!model.groups.empty()) {
    frames_.assign(model.vessels.size(), YawFrame<Scalar>(BodyKinematics<Scalar>::ground()));
  }
  state_.resize(model.load_states.size());
  state_rate_.resize(state_.size());
  inertial_.resize(idx(model.inertial_tensions));
  wave_slopes_.resize(model.vessels.size());
  touched_.reserve(bodies_.size());
  const bool adds =
      std::ranges::any_of(model.loads.lists, [](const auto& list) { return list->kind.adds_inertia; });
  if (adds) added_.resize(bodies_.size());
}

void BodyResidual::start(const Terms& terms, double t, const Held& held) {
  terms_ = &terms;
  t_ = t;
  held_ = held;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    moved_[b] = terms.bodies()[b];
    bodies_[b] = constant<Scalar>(terms.bodies()[b]);
  }
  for (std::size_t v = 0; v < frames_.size(); ++v) {
    frames_[v] = YawFrame<Scalar>(bodies_[idx(model_->vessels[v].body)]);
  }
  const double* states = terms.load_input(t, held.memory).states;
  for (std::size_t i = 0; i < state_.size(); ++i) state_[i] = Scalar(states[i]);
}

/// No slopes yet; what loads look at.
LoadInput<BodyResidual::Scalar> BodyResidual::clear() {
  for (int other : touched_) wrench_[idx(other)] = second_wrench_[idx(other)] = BodyLoad<Scalar>();
  touched_.clear();
  for (auto* rows : {&right_, &rate_, &position_, &state_rate_, &inertial_}) {
    std::fill(rows->begin(), rows->end(), Scalar());
  }
  const LoadInput<double> now = terms_->load_input(t_, held_.memory);
  sum_ = LoadSum<Scalar>{wrench_.data(), state_rate_.data()};
  return {t_, now.curve_limit, bodies_.data(), now.slots, state_.data(), now.inertial, now.sea};
}

void BodyResidual::differentiate(int b) {
  const int vessel = model_->bodies[idx(b)].vessel;
  const bool grouped = vessel >= 0 && model_->group_of(vessel) != nullptr;
  seed(terms_->bodies()[idx(b)], bodies_[idx(b)]);
  const LoadInput<Scalar> input = clear();
  add_inertia(b);
  add_loads(b, input);
  add_hydrodynamics(b, input);
  if (grouped) {
    frames_[idx(vessel)] = YawFrame<Scalar>(bodies_[idx(b)]);
    add_coupled_inertia(vessel);
    add_group_memory(vessel);
  }
  add_waves(b);
  add_rows(b);
  bodies_[idx(b)] = constant<Scalar>(terms_->bodies()[idx(b)]);
  if (grouped) frames_[idx(vessel)] = YawFrame<Scalar>(bodies_[idx(b)]);
}

void BodyResidual::differentiate_states(int first) {
  const LoadInput<Scalar> input = clear();
  const int last = std::min(first + kDirections, static_cast<int>(state_.size()));
  for (int i = first; i < last; ++i) state_[idx(i)].slope[idx(i - first)] = 1.0;
  model_->loads.for_each([&](const LoadList& list, std::size_t i) {
    if (list.kind.by_differences || !list.looks_at_states(i, first, last)) return;
    for (const int b : list.bodies[i]) wrench(b);
    add_load(list, i, input);
  });
  for (int i = first; i < last; ++i) state_[idx(i)].slope[idx(i - first)] = 0.0;
}

void BodyResidual::add_load(const LoadList& list, std::size_t i, const LoadInput<Scalar>& input) {
  list.apply(i, input, sum_);
  if (list.kind.adds_inertia) add_added_inertia(list, i, input);
  const int place = list.inertial_place(i);
  if (place >= 0) inertial_[idx(place)] = list.inertial(i, input, held_.acceleration);
}

/// -(what the load adds to M) vdot.
void BodyResidual::add_added_inertia(const LoadList& list, std::size_t i, const LoadInput<Scalar>& input) {
  for (const int b : list.bodies[i]) added_[idx(b)].setZero();
  list.add_inertia(i, input, added_.data());
  for (const int b : list.bodies[i]) {
    const Vec6<Scalar> fluid = added_[idx(b)] * held_.acceleration[b].cast<Scalar>();
    BodyLoad<Scalar>& out = wrench(b);
    out.force -= fluid.head<3>();
    out.moment -= fluid.tail<3>();
    added_[idx(b)].setZero();  // a load may name a body twice
  }
}

BodyResidual::Slopes BodyResidual::slopes(const BodyLoad<Scalar>& w) {
  Slopes out;
  for (int i = 0; i < 3; ++i) {
    for (int d = 0; d < kDirections; ++d) {
      out(i, d) = w.force[i].slope[idx(d)];
      out(3 + i, d) = w.moment[i].slope[idx(d)];
    }
  }
  return out;
}

BodyLoad<BodyResidual::Scalar>& BodyResidual::wrench(int b) {
  if (std::find(touched_.begin(), touched_.end(), b) == touched_.end()) touched_.push_back(b);
  return wrench_[idx(b)];
}

void BodyResidual::seed(const BodyKinematics<double>& k, BodyKinematics<Scalar>& out) const {
  for (int i = 0; i < 3; ++i) {
    out.position[i] = Scalar::variable(k.position[i], i);
    out.velocity[i] = Scalar::variable(k.velocity[i], 6 + i);
    out.angular_velocity[i] = Scalar::variable(k.angular_velocity[i], 9 + i);
    const Mat3d turned = skew<double>(Vec3d::Unit(i)) * k.rotation;
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) out.rotation(r, c).slope[idx(3 + i)] = turned(r, c);
    }
  }
}

/// -(M vdot + b), eqs (5) and (12) about the state point, with the added mass of a vessel.
void BodyResidual::add_inertia(int b) {
  const BodyModel& body = model_->bodies[idx(b)];
  const auto& k = bodies_[idx(b)];
  const Vec6<Scalar> rate = held_.acceleration[b].cast<Scalar>();
  const Vec3<Scalar> a = rate.head<3>(), alpha = rate.tail<3>(), omega = k.angular_velocity;
  const Mat3<Scalar> inertia = body.inertia.cast<Scalar>();
  const auto about_center = [&](const Vec3<Scalar>& w) -> Vec3<Scalar> {
    const Vec3<Scalar> in_body = k.rotation.transpose() * w;
    const Vec3<Scalar> momentum = inertia * in_body;
    return k.rotation * momentum;
  };
  const Vec3<Scalar> c = k.rotation * body.center_of_mass.cast<Scalar>();
  const Vec3<Scalar> swing = cross<Scalar>(omega, cross<Scalar>(omega, c));
  const Vec3<Scalar> at_center = a + cross<Scalar>(alpha, c) + swing;
  const Vec3<Scalar> force = Scalar(body.mass) * at_center;
  BodyLoad<Scalar>& out = wrench(b);
  out.force -= force;
  out.moment -= about_center(alpha) + cross<Scalar>(omega, about_center(omega)) + cross<Scalar>(c, force);
  if (body.vessel < 0) return;
  const YawFrame<Scalar> frame(k);
  const Vec6<Scalar> fluid =
      model_->vessels[idx(body.vessel)].added_mass.cast<Scalar>() * frame.twist_rate(rate);
  const Vec6<Scalar> added = frame.to_inertial(fluid);
  out.force -= added.head<3>();
  out.moment -= added.tail<3>();
}

void BodyResidual::add_loads(int b, const LoadInput<Scalar>& input) {
  for (const Gravity& load : model_->gravity) {
    if (load.body == b) load.apply<Scalar>(input, sum_);
  }
  model_->loads.for_each([&](const LoadList& list, std::size_t i) {
    const std::vector<int>& bodies = list.bodies[i];
    if (std::find(bodies.begin(), bodies.end(), b) == bodies.end()) return;
    for (const int other : bodies) wrench(other);
    if (list.kind.by_differences) {
      add_differences(list, i);
    } else {
      add_load(list, i, input);
    }
  });
}

void BodyResidual::add_differences(const LoadList& list, std::size_t i) {
  const auto b = idx(list.bodies[i].front());
  LoadInput<double> input = terms_->load_input(t_, held_.memory);
  input.bodies = moved_.data();
  const auto at = [&](int direction, double step) {
    moved_[b] = moved(terms_->bodies()[b], direction, step);
    moved_wrench_[b] = BodyLoad<double>();
    LoadSum<double> out{moved_wrench_.data()};
    list.apply(i, input, out);
    return (Eigen::Matrix<double, 7, 1>() << moved_wrench_[b].force, moved_wrench_[b].moment, out.power)
        .finished();
  };
  const double power_here = at(0, 0.0)[6];
  for (int d = 0; d < kDirections; ++d) {
    const Eigen::Matrix<double, 7, 1> slope = (at(d, kStep) - at(d, -kStep)) / (2.0 * kStep);
    for (int k = 0; k < 3; ++k) {
      wrench_[b].force[k].slope[idx(d)] += slope[k];
      wrench_[b].moment[k].slope[idx(d)] += slope[3 + k];
    }
    sum_.power.slope[idx(d)] += slope[6];
    sum_.absolute_power.slope[idx(d)] += sign(power_here) * slope[6];
  }
  moved_[b] = terms_->bodies()[b];
}

void BodyResidual::add_hydrodynamics(int b, const LoadInput<Scalar>& input) {
  const int v = model_->bodies[idx(b)].vessel;
  if (v < 0) return;
  const Vessel& vessel = model_->vessels[idx(v)];
  const YawFrame<Scalar> frame(bodies_[idx(b)]);
  const int own = vessel.memory_offset - model_->layout.memory;
  std::copy_n(held_.memory + own, vessel.memory_states(), memory_state_.begin());
  vessel.apply<Scalar>(input, frame, memory_state_.data(), memory_rate_.data(), sum_);
  const RunningConvolution* convolution = terms_->histories().of(v);
  if (!convolution) return;
  // Linear in the twist now; the history is fixed within a step.
  const Vec6d past = convolution->evaluate(t_, Vec6d::Zero());
  Vec6<Scalar> mu = past.cast<Scalar>();
  for (int i = 0; i < 6; ++i) {
    const Vec6d present = convolution->evaluate(t_, Vec6d::Unit(i)) - past;
    for (int j = 0; j < 6; ++j) mu[j] += present[j] * frame.twist[i];
  }
  vessel.radiate(frame, mu, sum_);
}

/// -R_i A_ij d/dt(R_j^T v_j) on both of every pair in which the vessel is.
void BodyResidual::add_coupled_inertia(int v) {
  const HydroGroup& group = *model_->group_of(v);
  const auto load = [&](int on, int by, const Mat6d& added_mass) {
    const Vec6<Scalar> rate = held_.acceleration[model_->vessels[idx(by)].body].cast<Scalar>();
    const Vec6<Scalar> fluid = added_mass.cast<Scalar>() * frames_[idx(by)].twist_rate(rate);
    const Vec6<Scalar> added = frames_[idx(on)].to_inertial(fluid);
    BodyLoad<Scalar>& out = wrench(model_->vessels[idx(on)].body);
    out.force -= added.head<3>();
    out.moment -= added.tail<3>();
  };
  for (const HydroGroup::Pair& pair : group.pairs) {
    const int first = group.vessels[idx(pair.first)], second = group.vessels[idx(pair.second)];
    if (first != v && second != v) continue;
    load(first, second, pair.added_mass);
    load(second, first, pair.added_mass.transpose());
  }
}

void BodyResidual::add_group_memory(int v) {
  const HydroGroup& group = *model_->group_of(v);
  const int own = group.memory_offset - model_->layout.memory;
  std::copy_n(held_.memory + own, group.memory.states(), memory_state_.begin());
  for (const int other : group.vessels) wrench(model_->vessels[idx(other)].body);
  group.apply<Scalar>(model_->vessels.data(), frames_.data(), memory_state_.data(), group_rate_.data(), sum_);
}

void BodyResidual::add_waves(int b) {
  for (std::size_t i = 0; i < model_->wave_loads.size(); ++i) {
    const WaveLoad& wave = model_->wave_loads[i];
    if (wave.body != b) continue;
    const YawFrame<Scalar> frame(bodies_[idx(b)]);
    Vec6<Scalar> force = terms_->waves(i).sum().cast<Scalar>();
    if (wave.sources.positioned) {
      const Vec3d pose = terms_->wave_pose(wave, held_.memory);
      WaveSlopes& slopes = wave_slopes_[idx(wave.vessel)];
      wave.sources.positioned->slopes(t_, pose[0], pose[1], pose[2], slopes.over_pose);
      for (int k = 0; k < 6; ++k) {
        const double* over = slopes.over_pose[k];
        force[k] += over[2] * (frame.yaw - Scalar(frame.yaw.value));
        force[k].slope[0] += over[0];
        force[k].slope[1] += over[1];
      }
    }
    const Vec6<Scalar> inertial = frame.to_inertial(force);
    wrench_[idx(b)].force += inertial.head<3>();
    wrench_[idx(b)].moment += inertial.tail<3>();
    const Scalar power = force.dot(frame.twist);
    wave_slopes_[idx(wave.vessel)].direction = power.value < 0.0 ? -1.0 : 1.0;
    sum_.add_power(power);
  }
}

void BodyResidual::add_rows(int b) {
  const Model& m = *model_;
  for (const JointKind& kind : joint_kinds()) {
    for (const JointData& joint : m.joints[kind.index]) {
      if ((joint.first != b && joint.second != b) || !counted_[idx(joint.element)]) continue;
      RowBlock<Scalar> block;
      kind.evaluate_slopes(joint, bodies_.data(), block);
      add_rows(block, m.elements[idx(joint.element)]);
    }
  }
  for (const DriverData& driver : m.drivers) {
    const JointData& joint = driver.coordinate.joint;
    if ((joint.first != b && joint.second != b) || !counted_[idx(driver.element)]) continue;
    RowBlock<Scalar> block;
    evaluate_driver<Scalar>(driver, driver.curve.at(t_, terms_->curve_limit()), bodies_[idx(joint.first)],
                            bodies_[idx(joint.second)], block);
    add_rows(block, m.elements[idx(driver.element)]);
  }
}

/// D^T lambda (and mu) on both bodies, gamma - D vdot, and what is left of the constraints.
void BodyResidual::add_rows(const RowBlock<Scalar>& block, const ElementModel& element) {
  const double beta = model_->description.baumgarte;
  const int bodies[2] = {element.first, element.second};
  for (int r = 0; r < element.rows; ++r) {
    const auto row = idx(element.row + r);
    rate_[row] = -block.nu[r];
    position_[row] = block.phi[r];
    right_[row] = block.gamma[r];
    for (int side = 0; side < 2; ++side) {
      if (bodies[side] == model_->body_count()) continue;
      const auto b = idx(bodies[side]);
      BodyLoad<Scalar>& load = wrench(bodies[side]);
      for (int i = 0; i < 6; ++i) {
        const Scalar& d = block.d[side](r, i);
        const auto part = [&](BodyLoad<Scalar>& w) -> Scalar& {
          return i < 3 ? w.force[i] : w.moment[i - 3];
        };
        part(load) += held_.multipliers[row] * d;
        if (held_.second_multipliers) part(second_wrench_[b]) += held_.second_multipliers[row] * d;
        right_[row] -= held_.acceleration[b][i] * d;
        rate_[row] += d * (i < 3 ? bodies_[b].velocity[i] : bodies_[b].angular_velocity[i - 3]);
      }
    }
    if (beta > 0.0) right_[row] -= (beta * beta) * position_[row] + (2.0 * beta) * rate_[row];
  }
}

}  // namespace seacrane
