#include "seacrane/run/recording.hpp"

#include <algorithm>
#include <cstring>

#include "seacrane/dynamics/limit_force.hpp"
#include "seacrane/elements/joints/distance.hpp"
#include "seacrane/elements/loads/actuator.hpp"

namespace seacrane {
namespace {

struct Offer {
  const char* name;
  std::vector<std::size_t> shape;
  bool by_default;
};

std::size_t joint_count(const Model& m) { return m.description.joints.size(); }
/// Described drivers; closed stops are drivers of the compiled model too.
std::size_t driver_count(const Model& m) { return m.description.drivers.size(); }

std::size_t distance_count(const Model& m) {
  std::size_t count = 0;
  for (const ElementModel& e : m.elements) count += e.kind == Distance::kind;
  return count;
}

/// A channel of every vessel: with one, without an axis of vessels.
std::vector<std::size_t> by_vessel(const Model& m, std::vector<std::size_t> shape) {
  if (m.vessels.size() > 1) shape.insert(shape.begin(), m.vessels.size());
  return shape;
}

const WaveComponents& sea_of(const WaveLoadDescription& load) {
  if (load.positioned) return load.positioned->waves();
  return load.exact ? load.exact->waves() : load.table->exact()->waves();
}

bool any_drift(const Model& m) {
  return std::any_of(m.wave_loads.begin(), m.wave_loads.end(),
                     [](const WaveLoad& wave) { return wave.sources.has_drift(); });
}

/// The one list of channels; what a scene does not hold is left out.
std::vector<Offer> offers(const Model& m) {
  const std::size_t n = m.bodies.size();
  std::vector<Offer> out = {{"position", {n, 3}, true},
                            {"velocity", {n, 3}, true},
                            {"angular_velocity", {n, 3}, true},
                            {"quaternion", {n, 4}, true},
                            {"euler_xyz", {n, 3}, true},
                            {"acceleration", {n, 3}, false},
                            {"angular_acceleration", {n, 3}, false}};
  if (!m.vessels.empty()) out.push_back({"vessel_motion", by_vessel(m, {6}), true});
  if (!m.coordinates.empty()) {
    out.push_back({"coordinate", {m.coordinates.size()}, true});
    out.push_back({"coordinate_rate", {m.coordinates.size()}, true});
  }
  if (!m.actuators().empty()) out.push_back({"actuator_force", {m.actuators().size()}, true});
  if (driver_count(m) > 0) out.push_back({"driver_force", {driver_count(m)}, true});
  if (joint_count(m) > 0) {
    out.push_back({"reaction_force", {joint_count(m), 3}, true});
    out.push_back({"reaction_moment", {joint_count(m), 3}, true});
  }
  if (distance_count(m) > 0) out.push_back({"tension", {distance_count(m)}, true});
  if (!m.wave_loads.empty()) {
    out.push_back({"wave_elevation", by_vessel(m, {}), true});
    out.push_back({"wave_force", by_vessel(m, {6}), true});
    if (any_drift(m)) out.push_back({"drift_force", by_vessel(m, {6}), true});
  }
  if (!m.limits.empty()) {
    out.push_back({"limit_force", {m.limits.size()}, true});
    out.push_back({"impact_loss", {}, true});
  }
  out.push_back({"constraint_error", {}, true});
  out.push_back({"constraint_rate_error", {}, true});
  out.push_back({"constraint_error_before_projection", {}, true});
  if (!m.paper_kinematics) {
    out.push_back({"energy_balance", {}, true});
    out.push_back({"absolute_work", {}, true});
  }
  return out;
}

/// Where the reaction of a joint is taken: the second body's point, or the first's where the joint slides.
Vec3d joint_point(const ElementModel& e, const std::vector<BodyKinematics<double>>& bodies) {
  const BodyKinematics<double>& k = bodies[idx(e.slides ? e.first : e.second)];
  return k.position + k.rotation * (e.slides ? e.first_point : e.second_point);
}

}  // namespace

std::vector<std::string> channel_names(const Model& model, bool defaults_only) {
  std::vector<std::string> names;
  for (const Offer& offer : offers(model)) {
    if (offer.by_default || !defaults_only) names.emplace_back(offer.name);
  }
  return names;
}

Recording::Recording(const Model& model, const std::set<std::string>& names, std::size_t capacity)
    : model_(&model) {
  for (const Offer& offer : offers(model)) {
    if (names.count(offer.name) == 0) continue;
    Channel channel{offer.name, offer.shape, width_, 1};
    for (std::size_t n : offer.shape) channel.size *= n;
    width_ += channel.size;
    channels_.push_back(channel);
  }
  row_.assign(width_, 0.0);
  rows_.reserve(width_ * capacity);
  times_.reserve(capacity);
  const std::pair<const char*, double**> places[] = {
      {"position", &at_.position},
      {"velocity", &at_.velocity},
      {"angular_velocity", &at_.angular_velocity},
      {"quaternion", &at_.quaternion},
      {"euler_xyz", &at_.euler_xyz},
      {"acceleration", &at_.acceleration},
      {"angular_acceleration", &at_.angular_acceleration},
      {"vessel_motion", &at_.vessel_motion},
      {"coordinate", &at_.coordinate},
      {"coordinate_rate", &at_.coordinate_rate},
      {"actuator_force", &at_.actuator_force},
      {"driver_force", &at_.driver_force},
      {"reaction_force", &at_.reaction_force},
      {"reaction_moment", &at_.reaction_moment},
      {"tension", &at_.tension},
      {"wave_elevation", &at_.wave_elevation},
      {"wave_force", &at_.wave_force},
      {"drift_force", &at_.drift_force},
      {"limit_force", &at_.limit_force},
      {"impact_loss", &at_.impact_loss},
      {"constraint_error", &at_.constraint_error},
      {"constraint_rate_error", &at_.constraint_rate_error},
      {"constraint_error_before_projection", &at_.constraint_error_before_projection},
      {"energy_balance", &at_.energy_balance},
      {"absolute_work", &at_.absolute_work}};
  for (const Channel& channel : channels_) {
    for (const auto& [name, place] : places) {
      if (channel.name == name) *place = row_.data() + channel.offset;
    }
  }
}

void Recording::drop(std::size_t count) {
  count = std::min(count, times_.size());
  times_.erase(times_.begin(), times_.begin() + static_cast<std::ptrdiff_t>(count));
  rows_.erase(rows_.begin(), rows_.begin() + static_cast<std::ptrdiff_t>(count * width_));
}

std::vector<double> Recording::last_quaternions() const {
  std::vector<double> out;
  for (const Vec4d& q : last_quaternion_) out.insert(out.end(), q.data(), q.data() + 4);
  return out;
}

void Recording::go_on_from(const std::vector<double>& quaternions) {
  if (quaternions.size() != 4 * model_->bodies.size()) return;
  last_quaternion_.clear();
  for (std::size_t b = 0; b < model_->bodies.size(); ++b) {
    last_quaternion_.emplace_back(view<4>(quaternions.data() + 4 * b));
  }
}

bool Recording::wants_solution() const {
  return at_.acceleration || at_.angular_acceleration || at_.driver_force || at_.reaction_force ||
         at_.reaction_moment || at_.tension || at_.limit_force;
}

void Recording::write_bodies(RedundantSystem& system) {
  double* position = at_.position;
  double* velocity = at_.velocity;
  double* angular = at_.angular_velocity;
  double* euler = at_.euler_xyz;
  double* acceleration = at_.acceleration;
  double* angular_acceleration = at_.angular_acceleration;
  for (int b = 0; b < model_->body_count(); ++b) {
    const BodyKinematics<double>& k = system.bodies()[idx(b)];
    const Vec3d lever = k.rotation * model_->bodies[idx(b)].center_of_mass;
    const Vec3d &w = k.angular_velocity, turning = w.cross(lever);
    const Vec6d& a = system.acceleration()[idx(b)];
    if (position) view<3>(position + 3 * b) = k.position + lever;
    if (velocity) view<3>(velocity + 3 * b) = k.velocity + turning;
    if (angular) view<3>(angular + 3 * b) = w;
    if (euler) view<3>(euler + 3 * b) = euler_xyz_from_rotation(k.rotation);
    if (angular_acceleration) view<3>(angular_acceleration + 3 * b) = a.tail<3>();
    if (acceleration) {
      view<3>(acceleration + 3 * b) = a.head<3>() + Vec3d(a.tail<3>()).cross(lever) + w.cross(turning);
    }
  }
}

void Recording::write_quaternions(const RedundantSystem& system) {
  double* out = at_.quaternion;
  if (!out) return;
  const bool first = last_quaternion_.empty();
  if (first) last_quaternion_.resize(model_->bodies.size());
  for (int b = 0; b < model_->body_count(); ++b) {
    Vec4d q = quaternion_from_rotation(system.bodies()[idx(b)].rotation);
    if (!first && q.dot(last_quaternion_[idx(b)]) < 0.0) q = -q;  // q and -q are the same orientation
    last_quaternion_[idx(b)] = q;
    view<4>(out + 4 * b) = q;
  }
}

void Recording::write_vessels(double t, const RedundantSystem& system) {
  if (double* out = at_.vessel_motion) {
    for (const Vessel& vessel : model_->vessels) {
      const BodyKinematics<double>& k = system.bodies()[idx(vessel.body)];
      view<3>(out) = vessel.displacement(k);
      view<3>(out + 3) = vessel.angles_from_mean(YawFrame<double>(k));
      out += 6;
    }
  }
  const auto& loads = model_->wave_loads;
  if (double* out = at_.wave_elevation; out && loads.size() < model_->vessels.size()) {
    // Of vessels that the waves do not load, where they rest.
    for (const Vessel& vessel : model_->vessels) {
      *out++ = sea_of(loads.front().sources).elevation(t, vessel.mean_position.x(), vessel.mean_position.y());
    }
  }
  for (std::size_t i = 0; i < loads.size(); ++i) {
    const WaveForces& waves = system.waves(i);
    const std::size_t v = idx(loads[i].vessel);
    if (double* out = at_.wave_elevation) out[v] = waves.elevation();
    if (double* out = at_.wave_force) view<6>(out + 6 * v) = waves.force();
    if (double* out = at_.drift_force) view<6>(out + 6 * v) = waves.drift();
  }
}

void Recording::write_joint_coordinates(double t, const RedundantSystem& system) {
  const auto& bodies = system.bodies();
  double* value = at_.coordinate;
  double* rate = at_.coordinate_rate;
  if (value || rate) {
    for (std::size_t i = 0; i < model_->coordinates.size(); ++i) {
      const CoordinateData& c = model_->coordinates[i];
      const auto &ka = bodies[idx(c.joint.first)], &kb = bodies[idx(c.joint.second)];
      const CoordinateRow<double> row = evaluate_coordinate<double>(c, ka, kb);
      if (value) value[i] = row.value;
      if (rate) rate[i] = coordinate_rate<double>(row, ka, kb);
    }
  }
  if (double* out = at_.actuator_force) {
    const LoadInput<double> input = system.load_input(t);
    for (const Actuator& a : model_->actuators()) {
      const JointData& j = a.coordinate.joint;
      *out++ = a.force<double>(
          input, evaluate_coordinate<double>(a.coordinate, bodies[idx(j.first)], bodies[idx(j.second)]));
    }
  }
  if (double* out = at_.driver_force) {
    for (std::size_t d = 0; d < driver_count(*model_); ++d) {
      *out++ = system.multipliers()[idx(system.model().elements[joint_count(*model_) + d].row)];
    }
  }
}

void Recording::write_reactions(const RedundantSystem& system) {
  if (double* out = at_.tension) {
    for (const ElementModel& e : system.model().elements) {
      if (e.kind == Distance::kind) *out++ = e.rows > 0 ? -system.multipliers()[idx(e.row)] : 0.0;
    }
  }
  if (double* out = at_.limit_force) {
    for (const Limit& limit : system.model().limits) {
      *out++ = limit.element < 0 ? 0.0 : limit_force(limit, system, system.multipliers().data());
    }
  }
  double* force = at_.reaction_force;
  double* moment = at_.reaction_moment;
  if (!force && !moment) return;
  for (std::size_t e = 0; e < joint_count(*model_); ++e) {
    const ElementModel& element = system.model().elements[e];
    const bool second_is_ground = element.second == model_->body_count();
    const int side = second_is_ground ? 0 : 1, body = second_is_ground ? element.first : element.second;
    Vec6d load = Vec6d::Zero();
    const RowBlock<double>& block = system.blocks()[e];
    for (int r = 0; r < element.rows; ++r) {
      load += block.d[side].row(r).transpose() * system.multipliers()[idx(element.row + r)];
    }
    if (second_is_ground) load = -load;
    const Vec3d f = load.head<3>();
    const Vec3d arm = joint_point(element, system.bodies()) - system.bodies()[idx(body)].position;
    if (force) view<3>(force + 3 * e) = f;
    if (moment) view<3>(moment + 3 * e) = Vec3d(load.tail<3>()) - arm.cross(f);
  }
}

void Recording::append(double t, const double* y, RedundantSystem& system, const Kept& kept) {
  write_bodies(system);
  write_quaternions(system);
  write_vessels(t, system);
  write_joint_coordinates(t, system);
  write_reactions(system);
  if (double* out = at_.constraint_error) *out = kept.after.position;
  if (double* out = at_.constraint_rate_error) *out = kept.after.rate;
  if (double* out = at_.constraint_error_before_projection) *out = kept.before;
  if (double* out = at_.energy_balance) *out = kept.energy_balance;
  if (double* out = at_.impact_loss) *out = kept.impact_loss;
  if (double* out = at_.absolute_work) *out = y[model_->layout.work + 1];
  times_.push_back(t);
  rows_.insert(rows_.end(), row_.begin(), row_.end());
}

}  // namespace seacrane
