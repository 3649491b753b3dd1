#include "seacrane/dynamics/terms.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "seacrane/dynamics/constraints.hpp"
#include "seacrane/dynamics/paper_kinematics.hpp"
#include "seacrane/model/model.hpp"

namespace seacrane {
namespace {

constexpr double kEulerLimit = 1e-3;  // cos(phi_y); negative: a step jumped over +-90 deg

}  // namespace

Terms::Terms(std::shared_ptr<const Model> model)
    : model_(std::move(model)),
      first_load_state_(model_->layout.loads - model_->layout.memory),
      slots_(idx(model_->slot_count), 0.0),
      inertial_(VecXd::Zero(model_->inertial_tensions)),
      told_(idx(model_->inertial_tensions)),
      histories_(*model_),
      sea_(model_->sea, model_->stencils, model_->near) {
  const Model& m = *model_;
  const auto bodies = idx(m.body_count());
  bodies_.assign(bodies + 1, BodyKinematics<double>::ground());
  frames_.assign(m.vessels.size(), YawFrame<double>(BodyKinematics<double>::ground()));
  inertia_.resize(bodies);
  paper_mass_.assign(bodies, Mat6d::Zero());
  wrench_.resize(bodies + 1);
  for (auto* vectors : {&bias_, &load_}) vectors->assign(bodies + 1, Vec6d::Zero());
  blocks_.resize(m.elements.size());
  for (const HydroGroup& group : m.groups) {
    group_mass_.emplace_back(static_cast<int>(group.vessels.size()));
    for (const HydroGroup::Pair& pair : group.pairs) {
      couplings_.push_back({m.vessels[idx(group.vessels[idx(pair.first)])].body,
                            m.vessels[idx(group.vessels[idx(pair.second)])].body});
    }
  }
  for (const WaveLoad& wave : m.wave_loads) waves_.emplace_back(wave.sources);
  for (const auto& list : m.loads.lists) {
    if (list->kind.adds_inertia) adding_inertia_.push_back(&*list);
  }
  if (!adding_inertia_.empty()) added_inertia_.assign(bodies + 1, Mat6d::Zero());
}

void Terms::read(double t, const double* y) {
  const Model& m = *model_;
  for (int b = 0; b < m.body_count(); ++b) {
    BodyKinematics<double>& k = bodies_[idx(b)];
    const double* pose = y + m.layout.pose(b);
    const double* twist = y + m.layout.twist(b);
    k.position = view<3>(pose);
    if (m.description.orientation == Orientation::quaternion) {
      k.rotation = rotation_from_quaternion<double>(view<4>(pose + 3));
    } else {
      k.rotation = rotation_from_euler_xyz<double>(view<3>(pose + 3));
      if (std::cos(pose[4]) < kEulerLimit) {
        throw std::domain_error("body '" + m.bodies[idx(b)].name + "': Euler angle phi_y is " +
                                std::to_string(pose[4] * 180.0 / 3.14159265358979323846) +
                                " deg at t = " + std::to_string(t) +
                                " s, where XYZ angles are singular; use orientation='quaternion'");
      }
    }
    k.velocity = view<3>(twist);
    k.angular_velocity = view<3>(twist + 3);
  }
  follow_yaw();
}

void Terms::follow_yaw() {
  for (std::size_t v = 0; v < model_->vessels.size(); ++v) {
    frames_[v] = YawFrame<double>(bodies_[idx(model_->vessels[v].body)]);
  }
}

void Terms::evaluate_inertia(double t, const double* memory) {
  const Model& m = *model_;
  const std::vector<Mat6d>& added = evaluate_added_inertia(t, memory);
  for (int b = 0; b < m.body_count(); ++b) {
    const BodyModel& body = m.bodies[idx(b)];
    const BodyKinematics<double>& k = bodies_[idx(b)];
    BodyInertia& out = inertia_[idx(b)];
    if (!body.full) {
      bias_[idx(b)] = compact_inertia(body, k, out);
      continue;
    }
    out.full = true;
    SpatialInertia<double> mass;
    bias_[idx(b)] = full_terms(m, body, mass_of(body), k, frames_.data(), mass).vector();
    out.mass = mass.matrix();
    if (!added.empty()) out.mass += added[idx(b)];
    out.inverse = spd_inverse(out.mass);
  }
  if (!couplings_.empty()) invert_coupled_masses();
}

const std::vector<MassCoupling>& Terms::evaluate_couplings(Vec6d* bias) {
  auto out = couplings_.begin();
  for (const HydroGroup& group : model_->groups) {
    group.couple<double>(frames_.data(), [&](const HydroGroup::Pair&, const Mat6d& mass, const Vec6d& first,
                                             const Vec6d& second) {
      out->mass = mass;
      bias[out->first] += first;
      bias[out->second] += second;
      ++out;
    });
  }
  return couplings_;
}

/// The bodies of a group have one inverse: its blocks take the place of theirs.
void Terms::invert_coupled_masses() {
  evaluate_couplings(bias_.data());
  auto coupling = couplings_.begin();
  for (std::size_t g = 0; g < group_mass_.size(); ++g) {
    const HydroGroup& group = model_->groups[g];
    if (group.pairs.empty()) continue;
    SpdBlocks<double>& mass = group_mass_[g];
    const auto of = [&](int place) -> BodyInertia& {
      return inertia_[idx(model_->vessels[idx(group.vessels[idx(place)])].body)];
    };
    const auto begin = coupling;
    for (int i = 0; i < mass.count(); ++i) mass.set(i, i, of(i).mass);
    for (const HydroGroup::Pair& pair : group.pairs) mass.set(pair.first, pair.second, (coupling++)->mass);
    mass.factor();
    mass.invert();
    for (int i = 0; i < mass.count(); ++i) of(i).inverse = mass.inverse(i, i);
    coupling = begin;
    for (const HydroGroup::Pair& pair : group.pairs) {
      (coupling++)->inverse = mass.inverse(pair.first, pair.second);
    }
  }
}

const std::vector<Mat6d>& Terms::evaluate_added_inertia(double t, const double* memory) {
  if (adding_inertia_.empty()) return added_inertia_;
  for (Mat6d& added : added_inertia_) added.setZero();
  const LoadInput<double> input = load_input(t, memory);
  for (const LoadList* const list : adding_inertia_) list->add_inertia(input, added_inertia_.data());
  return added_inertia_;
}

void Terms::evaluate_rows(double t) {
  evaluate_constraints(*model_, t, curve_limit_, bodies_.data(), blocks_.data());
}

void Terms::apply_hydrodynamics(const LoadInput<double>& input, const double* memory, double* memory_rate,
                                LoadSum<double>& sum) {
  const Model& m = *model_;
  for (std::size_t v = 0; v < m.vessels.size(); ++v) {
    const Vessel& vessel = m.vessels[v];
    const int own = vessel.memory_offset - m.layout.memory;
    const double* x = memory + own;
    double* x_rate = memory_rate + own;
    if (m.paper_kinematics) {
      const auto b = idx(vessel.body);
      const PaperVessel paper(m.bodies[b], vessel, bodies_[b], x, x_rate);
      paper_mass_[b] = paper.mass;
      wrench_[b].force += paper.load.head<3>();
      wrench_[b].moment += paper.load.tail<3>();
    } else {
      vessel.apply<double>(input, frames_[v], x, x_rate, sum);
    }
  }
  for (const HydroGroup& group : m.groups) {
    const int own = group.memory_offset - m.layout.memory;
    group.apply<double>(m.vessels.data(), frames_.data(), memory + own, memory_rate + own, sum);
  }
  for (const auto& [v, body, memory_of] : histories_) {
    m.vessels[v].radiate(frames_[v], memory_of.evaluate(input.time, frames_[v].twist), sum);
  }
}

Vec3d Terms::wave_pose(const WaveLoad& wave, const double* memory) const {
  const Vessel& vessel = model_->vessels[idx(wave.vessel)];
  const Vec3d& place = bodies_[idx(wave.body)].position;
  const Vec3d pose(place.x(), place.y(), frames_[idx(wave.vessel)].yaw);
  if (!vessel.fast) return pose;
  const int own = vessel.memory_offset - model_->layout.memory + vessel.fluid_states();
  return pose - FastMotion::of(memory + own);
}

void Terms::apply_waves(double t, const double* memory, LoadSum<double>& sum) {
  const Model& m = *model_;
  for (std::size_t i = 0; i < m.wave_loads.size(); ++i) {
    const WaveLoad& wave = m.wave_loads[i];
    const YawFrame<double>& frame = frames_[idx(wave.vessel)];
    waves_[i].evaluate(t, wave_pose(wave, memory));
    const Vec6d force = waves_[i].sum();
    const Vec6d inertial = m.paper_kinematics ? force : frame.to_inertial(force);
    wrench_[idx(wave.body)].force += inertial.head<3>();
    wrench_[idx(wave.body)].moment += inertial.tail<3>();
    sum.add_power(force.dot(frame.twist));
  }
}

void Terms::share_wave_knots(const Terms& other) {
  for (std::size_t i = 0; i < waves_.size(); ++i) waves_[i].share_knots(other.waves_[i]);
}

void Terms::evaluate_wrenches(double t, const double* memory, double* memory_rate) {
  evaluate_wrenches(t, memory, memory_rate, model_->loads);
}

void Terms::evaluate_wrenches(double t, const double* memory, double* memory_rate,
                              const CompiledLoads& loads) {
  const Model& m = *model_;
  for (auto& w : wrench_) w = BodyLoad<double>();
  inertial_.setZero();
  const LoadInput<double> input = load_input(t, memory);
  LoadSum<double> sum{wrench_.data(), memory_rate + first_load_state_};
  sum.inertial = told_.data();
  for (const auto& load : m.gravity) load.apply<double>(input, sum);
  for (const auto& list : loads.lists) list->apply(input, sum);
  apply_hydrodynamics(input, memory, memory_rate, sum);
  apply_waves(t, memory, sum);
  power_ = {sum.power, sum.absolute_power};
}

void Terms::add_inertial(const VecXd& tension) {
  inertial_ = tension;
  for (std::size_t i = 0; i < told_.size(); ++i) {
    const double pull = tension[static_cast<Eigen::Index>(i)];
    for (const InertialTension::Pull& p : told_[i].pulls) {
      if (p.body == model_->body_count()) continue;
      const Wrench<double> by = pull * p.unit();
      wrench_[idx(p.body)].force += by.force();
      wrench_[idx(p.body)].moment += by.moment();
      p.add_to(load_[idx(p.body)], pull);
    }
    power_.add(told_[i].winding * pull);
  }
}

void Terms::evaluate_loads(double t, const double* y, double* ydot) {
  const Model& m = *model_;
  evaluate_wrenches(t, y + m.layout.memory, ydot + m.layout.memory);
  for (int b = 0; b < m.body_count(); ++b) {
    load_[idx(b)] = wrench(b);
    // The paper's vessel carries its velocity terms in its own load.
    if (!(m.paper_kinematics && m.bodies[idx(b)].vessel >= 0)) load_[idx(b)] -= bias_[idx(b)];
  }
}

void Terms::evaluate(double t, const double* y, double* ydot) {
  read(t, y);
  evaluate_inertia(t, y + model_->layout.memory);
  evaluate_rows(t);
  evaluate_loads(t, y, ydot);
}

Mat6d Terms::mass_matrix(int body) const {
  const bool unsymmetric = model_->paper_kinematics && model_->bodies[idx(body)].vessel >= 0;
  return unsymmetric ? paper_mass_[idx(body)] : symmetric_mass(body);
}

Mat6d Terms::symmetric_mass(int body) const {
  const BodyModel& b = model_->bodies[idx(body)];
  return b.full ? inertia_[idx(body)].mass : rigid_mass_matrix(b, bodies_[idx(body)].rotation);
}

WaveForces::WaveForces(const WaveLoadDescription& sources) : sources_(&sources) {
  if (sources.table) block_ = std::make_shared<WaveTableBlock>(sources.table->make_block());
  if (sources.drift_table) {
    drift_block_ = std::make_shared<DriftTableBlock>(sources.drift_table->make_block());
  }
}

void WaveForces::share_knots(const WaveForces& other) {
  if (sources_->table == other.sources_->table) block_ = other.block_;
  if (sources_->drift_table == other.sources_->drift_table) drift_block_ = other.drift_block_;
}

void WaveForces::evaluate(double t, const Vec3d& pose) {
  const WaveLoadDescription& s = *sources_;
  if (s.positioned) {
    PositionedLoad load;
    s.positioned->evaluate(t, pose[0], pose[1], pose[2], load);
    force_ = view<6>(load.force);
    drift_ = view<6>(load.drift);
    elevation_ = load.elevation;
    return;
  }
  double load[wave_channels];
  if (s.table) {
    s.table->evaluate(t, *block_, load);
  } else {
    s.exact->evaluate(t, load);
  }
  force_ = view<6>(load);
  elevation_ = load[6];
  if (s.drift_table) {
    s.drift_table->evaluate(t, *drift_block_, drift_.data());
  } else if (s.drift) {
    s.drift->evaluate(t, drift_.data());
  }
}

VesselHistories::VesselHistories(const Model& model) {
  for (std::size_t v = 0; v < model.vessels.size(); ++v) {
    const auto* tables = std::get_if<Convolution>(&model.vessels[v].memory);
    if (tables) histories_.push_back({v, idx(model.vessels[v].body), RunningConvolution(*tables)});
  }
}

const RunningConvolution* VesselHistories::of(int vessel) const {
  for (const History& h : histories_) {
    if (h.vessel == idx(vessel)) return &h.memory;
  }
  return nullptr;
}

std::vector<TwistHistory> VesselHistories::save() const {
  std::vector<TwistHistory> out;
  for (const History& h : histories_) out.push_back(h.memory.save());
  return out;
}

void VesselHistories::restore(double t, const std::vector<TwistHistory>& saved) {
  if (saved.size() != histories_.size()) {
    throw std::invalid_argument("state: has " + std::to_string(saved.size()) + " histories, the model has " +
                                std::to_string(histories_.size()) +
                                " vessels with a convolution; give a state of this scene");
  }
  for (std::size_t i = 0; i < saved.size(); ++i) histories_[i].memory.restore(t, saved[i]);
}

void VesselHistories::start(double t, const std::vector<YawFrame<double>>& frames,
                            const std::vector<Vec6d>& acceleration) {
  for (History& h : histories_) {
    const YawFrame<double>& frame = frames[h.vessel];
    h.memory.start(t, frame.twist, frame.twist_rate(acceleration[h.body]));
  }
}

double VesselHistories::next_sample() const {
  double next = std::numeric_limits<double>::infinity();
  for (const History& h : histories_) next = std::min(next, h.memory.next());
  return next;
}

void VesselHistories::sample(double t, const std::vector<YawFrame<double>>& frames) {
  for (History& h : histories_) {
    if (h.memory.next() <= t) h.memory.sample(frames[h.vessel].twist);
  }
}

}  // namespace seacrane
