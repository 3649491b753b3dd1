#include "pinocchio_dynamics.hpp"

#include <pinocchio/algorithm/constrained-dynamics.hpp>
#include <pinocchio/algorithm/kinematics.hpp>

namespace pin = pinocchio;
using Eigen::Map, Eigen::Vector3d, Eigen::VectorXd;

namespace {

using Constraints = std::vector<pin::RigidConstraintModel>;

struct Tree {
  const TreeData &data;
  pin::Model model;
  std::map<int, Vector3d>
      origins; // of the joints' frames, inertial, at the start

  Vector3d vector(const std::string &key) const {
    return Map<const Vector3d>(data.at(key).data());
  }

  template <class Joint>
  int add(int parent, const Joint &joint, const Vector3d &at,
          const std::string &name) {
    const Vector3d place = parent == 0 ? at : Vector3d(at - origins[parent]);
    const int id = int(model.addJoint(
        parent, joint, pin::SE3(Eigen::Matrix3d::Identity(), place), name));
    origins[id] = at;
    return id;
  }

  void body(int joint, const std::string &name) {
    const auto &b = data.at("body " + name);
    const Vector3d com(b[1], b[2], b[3]);
    const Eigen::Matrix3d inertia = Map<const Eigen::Matrix3d>(b.data() + 4);
    model.appendBodyToJoint(joint,
                            pin::Inertia(b[0], com - origins[joint], inertia));
  }

  pin::SE3 at(int joint, const Vector3d &point) {
    return {Eigen::Matrix3d::Identity(), point - origins[joint]};
  }

  // Foot on the carrier, barrel, rod; returns the rod's joint.
  int cylinder(int carrier, const std::string &foot, const std::string &name) {
    const Vector3d at = vector("point " + foot);
    const int first = add(carrier, pin::JointModelRY(), at, foot + "1");
    const int barrel = add(
        first, pin::JointModelRevoluteUnaligned(vector("second_axis " + foot)),
        at, foot + "2");
    body(barrel, name + "_barrel");
    const int rod = add(
        barrel,
        pin::JointModelPrismaticUnaligned(vector("axis " + name + "_cylinder")),
        at, name);
    body(rod, name + "_rod");
    return rod;
  }
};

struct Crane {
  pin::Model model;
  Constraints constraints;
  int payload = 0;
  Vector3d payload_centre;
};

Crane build(const TreeData &data, double baumgarte) {
  Tree tree{data, {}, {}};
  tree.model.gravity.linear(Vector3d(0, 0, -data.at("gravity")[0]));
  const int place =
      tree.add(0, pin::JointModelTranslation(), Vector3d::Zero(), "place");
  const int hull = tree.add(place, pin::JointModelSphericalZYX(),
                            Vector3d::Zero(), "angles");
  tree.body(hull, "vessel");
  tree.body(hull, "tower");
  const int king =
      tree.add(hull, pin::JointModelRZ(), tree.vector("point A"), "A");
  tree.body(king, "king");
  const int main_rod = tree.cylinder(king, "B", "main");
  const int main_jib =
      tree.add(king, pin::JointModelRY(), tree.vector("point C"), "C");
  tree.body(main_jib, "main_jib");
  const int knuckle_rod = tree.cylinder(main_jib, "E", "knuckle");
  const int knuckle_jib =
      tree.add(main_jib, pin::JointModelRY(), tree.vector("point F"), "F");
  tree.body(knuckle_jib, "knuckle_jib");
  const Vector3d tip = tree.vector("point link"),
                 top = tree.vector("second_point link");
  const int link = tree.add(knuckle_jib, pin::JointModelRX(), tip, "link1");
  const int link2 = tree.add(link, pin::JointModelRY(), tip, "link2");
  const int payload =
      tree.add(link2, pin::JointModelSphericalZYX(), top, "payload");
  tree.body(payload, "payload");

  Crane crane;
  const auto close = [&](int rod, int jib, const std::string &at) {
    const Vector3d point = tree.vector("point " + at);
    crane.constraints.emplace_back(pin::CONTACT_3D, tree.model, rod,
                                   tree.at(rod, point), jib,
                                   tree.at(jib, point), pin::LOCAL);
    auto &corrector = crane.constraints.back().baumgarte_corrector_parameters();
    corrector.Kp = baumgarte * baumgarte;
    corrector.Kd = 2.0 * baumgarte;
  };
  close(main_rod, main_jib, "D");
  close(knuckle_rod, knuckle_jib, "G");
  const auto &b = data.at("body payload");
  crane.payload_centre = Vector3d(b[1], b[2], b[3]) - top;
  crane.payload = payload;
  crane.model = std::move(tree.model);
  return crane;
}

} // namespace

struct PinocchioDynamics::Parts {
  Crane crane;
  Loads loads;
  pin::Data data;
  std::vector<pin::RigidConstraintData> constraint_data;
  pin::ProximalSettings settings{1e-12, 0.0, 1};
  VectorXd q, v, load;

  Parts(const TreeData &tree, double baumgarte)
      : crane(build(tree, baumgarte)), loads(tree), data(crane.model) {
    if (crane.model.nv != coordinates || crane.model.nq != coordinates)
      throw std::runtime_error("coordinates");
    for (const auto &c : crane.constraints)
      constraint_data.emplace_back(c);
    q = v = load = VectorXd::Zero(coordinates);
    pin::initConstraintDynamics(crane.model, data, crane.constraints,
                                constraint_data);
  }

  void operator()(double t, const double *y, double *rate) {
    std::copy(y, y + coordinates, q.data());
    std::copy(y + coordinates, y + 2 * coordinates, v.data());
    loads(t, q.data(), v.data(), load.data());
    pin::constraintDynamics(crane.model, data, q, v, load, crane.constraints,
                            constraint_data, settings);
    std::copy(v.data(), v.data() + coordinates, rate);
    std::copy(data.ddq.data(), data.ddq.data() + coordinates,
              rate + coordinates);
  }

  std::array<double, 3> payload(const std::vector<double> &y) {
    std::copy(y.begin(), y.begin() + coordinates, q.data());
    pin::forwardKinematics(crane.model, data, q);
    const Vector3d p = data.oMi[crane.payload].act(crane.payload_centre);
    return {p[0], p[1], p[2]};
  }
};

PinocchioDynamics::PinocchioDynamics(const TreeData &tree, double baumgarte)
    : parts_(std::make_unique<Parts>(tree, baumgarte)) {}
PinocchioDynamics::~PinocchioDynamics() = default;

void PinocchioDynamics::operator()(double t, const double *y, double *rate) {
  (*parts_)(t, y, rate);
}

std::array<double, 3> PinocchioDynamics::payload(const std::vector<double> &y) {
  return parts_->payload(y);
}
