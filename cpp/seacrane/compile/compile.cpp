#include "seacrane/compile/compile.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "seacrane/compile/steps.hpp"
#include "seacrane/dynamics/merged_bodies.hpp"
#include "seacrane/elements/joints/joint_kinds.hpp"
#include "seacrane/elements/loads/heave_signal.hpp"
#include "seacrane/model/validate.hpp"

namespace seacrane {
namespace {

// Scales of absolute tolerances, typical of a vessel in waves: with them the energy balance of the lift
// cases closes to 1e-6 of the absolute work at rtol = 1e-6.
constexpr double kTranslationScale = 0.1;  // m, m/s, times the scene's length scale
constexpr double kRotationScale = 0.01;    // rad, rad/s: the same at a lever of 10 m
constexpr double kLeastGyration = 1e-2;    // over the longest arm of a body, where geometry is judged

class Compiler final : private LoadContext {
 public:
  Compiler(const SceneDescription& scene, MergePlan merge, std::vector<Limit> limits = {},
           ClosedSet closed = 0)
      : scene_(scene) {
    model_.description = scene;
    model_.sea = scene.sea;
    model_.merge = std::move(merge);
    model_.limits = std::move(limits);
    model_.closed = closed;
  }

  /// Where a model `like` it is in the same sea, they share how they see it.
  Model run(const Model* like = nullptr) {
    bodies();
    joints();
    drivers();
    shapes();
    limits();
    loads();
    const bool alike = like != nullptr && like->sea == model_.sea && like->stencils == model_.stencils;
    model_.near = alike ? like->near : NearSea::of(model_.sea, model_.stencils);
    vessels();
    add_groups(model_);
    layout();
    start();
    return std::move(model_);
  }

 private:
  Attachment attach(const std::string& body, const Vec3d& point) const override {
    const Placement p = place(body);
    const Vec3d in_body = p.point(point);
    if (p.body == ground()) return {p.body, in_body, p.axes};
    return {p.body, in_body - model_.bodies[idx(p.body)].state_point, p.axes};
  }

  CoordinateData coordinate(const CoordinateDescription& d) const override {
    static const std::map<std::string, CoordinateKind> kinds = {
        {"angle", CoordinateKind::angle}, {"displacement", CoordinateKind::displacement},
        {"x", CoordinateKind::x},         {"y", CoordinateKind::y},
        {"z", CoordinateKind::z},         {"roll", CoordinateKind::roll},
        {"pitch", CoordinateKind::pitch}, {"yaw", CoordinateKind::yaw}};
    CoordinateData out{joint_data(*joint_.at(d.joint)), kinds.at(d.coordinate)};
    const auto element = element_.find(d.joint);
    out.joint.element = element == element_.end() ? -1 : element->second;
    return out;
  }

  JointData joint_data(const JointDescription& d) const {
    const Attachment first = attach(d.first, d.first_frame.point);
    const Attachment second = attach(d.second, d.second_frame.point);
    JointData j;
    j.first = first.body;
    j.second = second.body;
    j.first_point = first.point;
    j.second_point = second.point;
    j.first_axes = first.axes * d.first_frame.axes;
    j.second_axes = second.axes * d.second_frame.axes;
    j.parameters = find_joint_kind(d.kind)->values(d);
    return j;
  }

  int state(LoadState state) override {
    model_.load_states.push_back(std::move(state));
    return static_cast<int>(model_.load_states.size()) - 1;
  }
  double mass(const std::string& body) const override { return scene_.bodies[idx(index_.at(body))].mass; }
  double gravity() const override { return scene_.gravity; }
  double length_scale() const override { return kTranslationScale * scene_.length_scale; }
  int ground() const override { return static_cast<int>(model_.merge.carriers.size()); }
  int inertial_tension() override { return model_.inertial_tensions++; }
  int stencil(const FlowStencil& stencil) override {
    const auto same = std::ranges::find(model_.stencils, stencil);
    if (same != model_.stencils.end()) return static_cast<int>(same - model_.stencils.begin());
    model_.stencils.push_back(stencil);
    return static_cast<int>(model_.stencils.size()) - 1;
  }
  int input(const std::string& name, int count) override {
    const int first = model_.slot_count;
    model_.inputs.push_back({name, first, count});
    model_.slot_count += count;
    return first;
  }
  void lead(const std::string& as, const std::string& name, const Followed& signal) override {
    led_[{as, name}] = signal;
  }
  Followed followed(const std::string& kind, const std::string& name) const override {
    const auto found = led_.find({find_load_kind(kind)->follows_as, name});
    return found == led_.end() ? Followed() : found->second;
  }

  Placement place(const std::string& body) const {
    return body == kGround ? Placement{ground()} : model_.merge.places[idx(index_.at(body))];
  }

  bool within_one_body(const JointDescription& d) const {
    return place(d.first).body == place(d.second).body;
  }

  void bodies() {
    std::map<std::string, int> vessel_on;
    for (std::size_t v = 0; v < scene_.vessels.size(); ++v)
      vessel_on[scene_.vessels[v].body] = static_cast<int>(v);
    for (int b = 0; b < static_cast<int>(scene_.bodies.size()); ++b) index_[scene_.bodies[idx(b)].name] = b;
    for (int b = 0; b < ground(); ++b) {
      BodyModel body = merged_body(b);
      const auto vessel = vessel_on.find(body.name);
      body.vessel = vessel == vessel_on.end() ? -1 : vessel->second;
      body.full = body.vessel >= 0;
      body.state_point = body.vessel < 0 ? body.center_of_mass : Vec3d::Zero();
      weigh(b, body);
      body.center_of_mass -= body.state_point;
      model_.bodies.push_back(body);
    }
  }

  /// Calls f(described body, its place) for what compiled body b carries.
  template <class F>
  void for_each_carried(int b, F&& f) const {
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
      if (model_.merge.places[i].body == b) f(scene_.bodies[i], model_.merge.places[i]);
    }
  }

  /// Mass, centre of mass (from the body origin) and inertia of all that moves as one.
  BodyModel merged_body(int b) const {
    BodyModel body;
    const BodyDescription& carrier = scene_.bodies[idx(model_.merge.carriers[idx(b)])];
    body.name = carrier.name;
    int count = 0;
    Vec3d moment = Vec3d::Zero();
    for_each_carried(b, [&](const BodyDescription& d, const Placement& p) {
      ++count;
      body.mass += d.mass;
      moment += d.mass * p.point(d.center_of_mass);
    });
    body.center_of_mass = count == 1 ? carrier.center_of_mass : Vec3d(moment / body.mass);
    body.inertia = count == 1 ? carrier.inertia : Mat3d::Zero();
    for_each_carried(b, [&](const BodyDescription& d, const Placement& p) {
      if (count == 1) return;
      const Mat3d s = skew<double>(Vec3d(p.point(d.center_of_mass) - body.center_of_mass));
      body.inertia += p.axes * d.inertia * p.axes.transpose() - d.mass * s * s;
    });
    body.inverse_inertia = body.inertia.inverse();
    return body;
  }

  /// One weight for all that a body carries. The restoring matrix of a vessel that floats carries its own
  /// weight and buoyancy.
  void weigh(int b, const BodyModel& body) {
    const bool floats = body.vessel >= 0 && scene_.vessels[idx(body.vessel)].floats;
    double mass = 0.0;
    Vec3d moment = Vec3d::Zero();
    for_each_carried(b, [&](const BodyDescription& d, const Placement& p) {
      if (!d.gravity || (floats && d.name == body.name)) return;
      mass += d.mass;
      moment += d.mass * (p.point(d.center_of_mass) - body.state_point);
    });
    if (mass > 0.0) model_.gravity.push_back({b, mass * scene_.gravity, moment / mass});
  }

  static ElementModel element_of(const std::string& name, const std::string& kind, const JointData& on) {
    ElementModel e;
    e.name = name;
    e.kind = kind;
    e.first = on.first;
    e.second = on.second;
    e.first_point = on.first_point;
    e.second_point = on.second_point;
    return e;
  }

  void joints() {
    model_.joints.resize(joint_kinds().size());
    for (const auto& d : scene_.joints) {
      joint_[d.name] = &d;
      if (within_one_body(d)) continue;
      JointData j = joint_data(d);
      j.element = element_[d.name] = static_cast<int>(model_.elements.size());
      ElementModel e = element_of(d.name, d.kind, j);
      const JointKind& kind = *find_joint_kind(d.kind);
      e.slides = kind.slides;
      if (!d.open) {
        e.rows = kind.rows;
        model_.joints[kind.index].push_back(j);
      }
      model_.elements.push_back(e);
    }
  }

  void drivers() {
    for (const auto& d : scene_.drivers) {
      if (within_one_body(*joint_.at(d.coordinate.joint))) continue;
      DriverData driver{coordinate(d.coordinate), d.curve, static_cast<int>(model_.elements.size())};
      ElementModel e = element_of(d.name, "driver", driver.coordinate.joint);
      e.rows = 1;
      e.driver = true;
      model_.elements.push_back(e);
      model_.drivers.push_back(driver);
    }
    std::vector<GraphNode> nodes;
    for (const auto& e : model_.elements) nodes.push_back({e.rows, e.first, e.second});
    model_.schur = BlockSchur(nodes, model_.body_count(), coupled_bodies());
    for (std::size_t e = 0; e < nodes.size(); ++e)
      model_.elements[e].row = model_.schur.row(static_cast<int>(e));
  }

  /// The pairs of all groups in turn.
  std::vector<CoupledBodies> coupled_bodies() const {
    std::vector<CoupledBodies> out;
    for (const HydroGroupDescription& d : scene_.groups) {
      if (d.added_mass.size() == 0) continue;
      const auto body = [&](std::size_t i) {
        return place(scene_.vessels[idx(vessel_of(scene_, d.vessels[i]))].body).body;
      };
      for (std::size_t i = 0; i < d.vessels.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) out.push_back({body(i), body(j)});
      }
    }
    return out;
  }

  /// A body of next to no inertia about its joints' lever arms makes their rows alike without being
  /// redundant: geometry is judged with radii of gyration of at least a hundredth of the longest arm.
  void shapes() {
    for (int b = 0; b < model_.body_count(); ++b) {
      BodyModel& body = model_.bodies[idx(b)];
      double arm = 0.0;
      for (const ElementModel& e : model_.elements) {
        if (e.first == b) arm = std::max(arm, (e.first_point - body.center_of_mass).norm());
        if (e.second == b) arm = std::max(arm, (e.second_point - body.center_of_mass).norm());
      }
      const double least = body.mass * std::pow(kLeastGyration * arm, 2);
      const Eigen::SelfAdjointEigenSolver<Mat3d> axes(body.inertia);
      body.shape = body.inertia;
      body.inverse_shape = body.inverse_inertia;
      if (axes.eigenvalues()[0] >= least) continue;
      const Vec3d moments = axes.eigenvalues().cwiseMax(least);
      body.shape = axes.eigenvectors() * moments.asDiagonal() * axes.eigenvectors().transpose();
      body.inverse_shape = body.shape.inverse();
    }
  }

  /// Where limits are measured, and the elements of those that hold: closed stops are the last drivers.
  void limits() {
    auto element = static_cast<int>(model_.elements.size());
    for (std::size_t i = model_.limits.size(); i-- > 0;) {
      Limit& limit = model_.limits[i];
      const bool here = holds(model_.closed, static_cast<int>(i));
      if (limit.kind->of_coordinate) {
        limit.coordinate = coordinate(limit.described);
        limit.element = here ? --element : -1;
      } else {
        limit.coordinate.joint = joint_data(scene_.joints[idx(limit.joint)]);
        limit.element = here ? limit.joint : -1;
      }
    }
  }

  void loads() {
    for (const auto& list : scene_.loads.lists) list->compile(*this, model_.loads);
    check_quasi_static();
    take_added_inertia();
    for (const auto& d : scene_.coordinates) model_.coordinates.push_back(coordinate(d));
    for (const auto& d : scene_.points) model_.points.push_back(attach(d.body, d.point));
  }

  void refuse_paper(const std::string& what, const char* or_else = "") const {
    const VesselDescription* const vessel = paper_vessel(scene_);
    if (vessel == nullptr) return;
    throw SceneError(what + "vessel '" + vessel->name +
                     "' has kinematics 'paper', whose mass is not symmetric; choose 'yaw_following'" +
                     or_else);
  }

  /// Impacts throw a stretch out of step with the tension, and the paper's masses have no response to loads.
  void check_quasi_static() const {
    model_.loads.for_each([&](const LoadList& list, std::size_t i) {
      if (list.inertial_place(i) < 0) return;
      const std::string what = name_of(list, i) + ": its stretch is quasi-static, and ";
      if (!model_.limits.empty()) {
        throw SceneError(what + "limit '" + model_.limits.front().name +
                         "' makes impacts, which shake the line; choose rung 'elastic'");
      }
      refuse_paper(what, ", or rung 'elastic'");
    });
  }

  /// Bodies to which loads add inertia have a full mass, which the paper's kinematics do not know.
  void take_added_inertia() {
    model_.loads.for_each([&](const LoadList& list, std::size_t i) {
      if (!list.kind.adds_inertia) return;
      refuse_paper(name_of(list, i) + ": it adds inertia, and ");
      for (const int b : list.bodies[i]) {
        if (b != ground()) model_.bodies[idx(b)].full = true;
      }
    });
  }

  void vessels() {
    for (const auto& d : scene_.vessels) {
      model_.vessels.push_back(vessel_at(d, scene_.bodies[idx(index_.at(d.body))]));
      model_.vessels.back().body = place(d.body).body;
      model_.paper_kinematics = d.kinematics == VesselKinematics::paper;
    }
    for (const auto& d : scene_.wave_loads) {
      const int b = place(d.body).body;
      const int v = model_.bodies[idx(b)].vessel;
      model_.wave_loads.push_back({b, v, d});
      if (d.positioned && d.positioned->cutoff() > 0.0) {
        model_.vessels[idx(v)].fast = FastMotion{d.positioned->cutoff()};
      }
    }
  }

  void layout() {
    StateLayout& s = model_.layout;
    s.bodies = model_.body_count();
    s.pose_size = scene_.orientation == Orientation::quaternion ? 7 : 6;
    s.velocity = s.pose_size * s.bodies;
    s.memory = s.velocity + 6 * s.bodies;
    s.work = s.memory;
    for (auto& v : model_.vessels) {
      v.memory_offset = s.work;
      s.work += v.memory_states();
    }
    for (HydroGroup& group : model_.groups) {
      group.memory_offset = s.work;
      s.work += group.memory.states();
    }
    s.loads = s.work;
    s.work += static_cast<int>(model_.load_states.size());
    s.size = s.work + 2;
    scales();
  }

  void scales() {
    const StateLayout& s = model_.layout;
    const double length = model_.translation_scale = length_scale();
    model_.rotation_scale = kRotationScale;
    std::vector<double>& scale = model_.scale;
    scale.assign(idx(s.size), std::numeric_limits<double>::infinity());  // work: not in the error norm
    for (int b = 0; b < s.bodies; ++b) {
      for (int i = 0; i < s.pose_size; ++i) scale[idx(s.pose(b) + i)] = i < 3 ? length : kRotationScale;
      for (int i = 0; i < 6; ++i) scale[idx(s.twist(b) + i)] = i < 3 ? length : kRotationScale;
    }
    for (std::size_t v = 0; v < model_.vessels.size(); ++v) {
      int i = model_.vessels[v].memory_offset;
      const auto* blocks = std::get_if<std::vector<StateSpaceBlock>>(&scene_.vessels[v].memory);
      if (blocks) scale_memory(*blocks, i);
      if (!model_.vessels[v].fast) continue;
      for (int k = 0; k < FastMotion::states; ++k) scale[idx(i++)] = k < 6 ? length : kRotationScale;
    }
    for (std::size_t g = 0; g < model_.groups.size(); ++g) {
      int i = model_.groups[g].memory_offset;
      scale_memory(scene_.groups[g].memory, i);
    }
    for (std::size_t i = 0; i < model_.load_states.size(); ++i) {
      scale[idx(s.loads) + i] = model_.load_states[i].scale;
    }
  }

  /// From state i on, which goes on behind them.
  void scale_memory(const std::vector<StateSpaceBlock>& blocks, int& i) {
    for (const StateSpaceBlock& block : blocks) {
      for (Eigen::Index k = 0; k < block.a.rows(); ++k) {
        model_.scale[idx(i++)] = block.state_scale.size() ? block.state_scale[k] : 1.0;
      }
    }
  }

  void start() {
    const StateLayout& s = model_.layout;
    std::vector<double>& y = model_.initial_state;
    y.assign(idx(s.size), 0.0);
    for (int b = 0; b < s.bodies; ++b) {
      const BodyDescription& d = scene_.bodies[idx(model_.merge.carriers[idx(b)])];
      const Vec4d q = d.quaternion.normalized();
      const Mat3d r = rotation_from_quaternion<double>(q);
      const Vec3d lever = r * model_.bodies[idx(b)].state_point;
      view<3>(&y[idx(s.pose(b))]) = d.position + lever;
      if (s.pose_size == 7) {
        view<4>(&y[idx(s.pose(b) + 3)]) = q;
      } else {
        view<3>(&y[idx(s.pose(b) + 3)]) = euler_xyz_from_rotation(r);
      }
      view<3>(&y[idx(s.twist(b))]) = d.velocity + d.angular_velocity.cross(lever);
      view<3>(&y[idx(s.twist(b) + 3)]) = d.angular_velocity;
    }
    for (std::size_t i = 0; i < model_.load_states.size(); ++i) {
      y[idx(s.loads) + i] = model_.load_states[i].initial;
    }
  }

  const SceneDescription& scene_;
  Model model_;
  std::map<std::string, int> index_;  // of described bodies
  std::map<std::string, const JointDescription*> joint_;
  std::map<std::string, int> element_;                           // of described joints that hold something
  std::map<std::pair<std::string, std::string>, Followed> led_;  // by what it is led as, and its name
};

/// A scene with every body by itself and, of its limits, the rows of a set.
std::shared_ptr<Model> described_model(const SceneDescription& scene, const std::vector<Limit>& limits,
                                       ClosedSet closed, const SceneDescription& with_rows,
                                       const Model* like = nullptr) {
  auto model = std::make_shared<Model>(Compiler(with_rows, no_merge(with_rows), limits, closed).run(like));
  if (!limits.empty()) model->description = scene;
  return model;
}

/// The model with all limits open. A stop that holds takes what a load does: what its own force does then
/// must be stopped at none the less, for it may let go.
std::shared_ptr<Model> when_open(const std::shared_ptr<Model>& model, ClosedSet closed) {
  if (closed == 0) return model;
  const SceneDescription scene = scene_of(model->description, model->limits, 0);
  const std::shared_ptr<Model> open =
      described_model(model->description, model->limits, 0, scene, model.get());
  open->initial_state = model->initial_state;
  return open;
}

}  // namespace

std::shared_ptr<const Model> compile(const SceneDescription& scene, bool merge) {
  validate(scene);
  const std::vector<Limit> limits = list_limits(scene);
  const ClosedSet closed = described_set(scene, limits);
  const SceneDescription with_rows = limits.empty() ? SceneDescription() : scene_of(scene, limits, closed);
  const SceneDescription& start = limits.empty() ? scene : with_rows;
  const std::shared_ptr<Model> model = described_model(scene, limits, closed, start);
  model->merges = merge;
  assemble(*model);
  start_fast_motions(*model);
  start_loads(*model);
  const std::shared_ptr<Model> open = when_open(model, closed);
  hang_on_lines(*model, find_line_bounces(*open));
  hang_on_lines(*open, model->line_bounces);
  if (merge) model->locked_loops = locked_loops(*model);
  MergePlan plan = merge ? plan_merge(start, model->locked_loops) : no_merge(start);
  if (plan.merges()) {
    auto merged = std::make_shared<Model>(Compiler(start, std::move(plan)).run(model.get()));
    std::vector<double> state(merged->initial_state);
    MergedBodies(*model, *merged).merge(model->initial_state.data(), state.data());
    merged->initial_state = std::move(state);
    assemble(*merged);
    hang_on_lines(*merged, model->line_bounces);
    model->merged = std::move(merged);
  }
  model->kinks = find_kinks(*open);
  return model;
}

std::shared_ptr<const Model> compile_set(const Model& model, ClosedSet closed) {
  const SceneDescription scene = scene_of(model.description, model.limits, closed);
  const std::shared_ptr<Model> out = described_model(model.description, model.limits, closed, scene, &model);
  out->merges = model.merges;
  out->initial_state = model.initial_state;
  out->kinks = model.kinks;
  out->locked_loops = model.locked_loops;
  hang_on_lines(*out, model.line_bounces);
  MergePlan plan = model.merges ? plan_merge(scene, model.locked_loops) : no_merge(scene);
  if (plan.merges()) {
    auto merged = std::make_shared<Model>(Compiler(scene, std::move(plan)).run(out.get()));
    hang_on_lines(*merged, model.line_bounces);
    out->merged = std::move(merged);
  }
  return out;
}

}  // namespace seacrane
