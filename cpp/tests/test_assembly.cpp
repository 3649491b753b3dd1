#include <doctest/doctest.h>

#include "multibody_scenes.hpp"
#include "seacrane/dynamics/constraints.hpp"
#include "seacrane/model/validate.hpp"

namespace seacrane::test {
namespace {

std::string refusal(const SceneDescription& scene) {
  try {
    compile(scene);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "accepted";
}

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("a closed start is left alone and reported with full rank") {
  const auto model = compile(slider_crank());
  const AssemblyReport& report = model->assembly;
  CHECK(report.largest_translation < 1e-12);
  CHECK(report.residual_before < 1e-12);
  CHECK(report.rank == model->rows());
  CHECK(model->rows() == 5 + 3 + 4 + 5 + 5 + 1 + 1);
  CHECK(!model->redundant);
  CHECK(report.redundant.empty());
  for (const auto& e : model->elements) CHECK(e.unique_reaction);
}

TEST_CASE("an approximate start is closed, and the report says how far what moved") {
  SceneDescription scene = slider_crank();
  for (auto& b : scene.bodies) {
    if (b.name == "slider") b.position += Vec3d(0.0, 0.05, -0.02);
    b.velocity = {0.1, 0.0, 0.0};
  }
  const auto model = compile(scene);
  const AssemblyReport& report = model->assembly;
  CHECK(report.residual_before > 0.02);
  CHECK(report.residual_after < 1e-12);
  CHECK(report.rate_residual_after < 1e-12);
  CHECK(report.largest_translation > 0.01);
  CHECK(report.largest_translation < 0.1);
  CHECK(report.velocity_change > 0.01);
  CHECK(!report.most_moved.empty());
  MaximalSystem system(model);
  CHECK(constraint_residual(system.terms(), 0.0, model->initial_state.data()).position < 1e-12);
}

TEST_CASE("a loop that cannot close is refused by its name and its gap") {
  SceneDescription scene = slider_crank();
  // The crank's circle stays 0.5 m from the pivot: a slider line 5 m away is out of the rod's reach.
  for (auto& j : scene.joints) {
    if (j.name == "guide") j.first_frame.point.y() += 5.0;
  }
  const std::string text = refusal(scene);
  CAPTURE(text);
  CHECK(says(text, "does not close"));
  const std::string loop = text.substr(0, text.find("does not close"));
  for (const char* name : {"bearing", "pin", "knee", "guide"}) CHECK(says(loop, name));
  for (const char* name : {"shoulder", "link", "swing"}) CHECK(!says(loop, name));
  // Crank 0.5 m and rod 1.5 m reach at most 2 m of the more than 4.5 m.
  const double gap = std::stod(text.substr(text.find("does not close, ") + 16));
  CHECK(gap > 0.5);
  CHECK(gap < 4.0);
}

TEST_CASE("contradicting joints between the same bodies are both named") {
  SceneDescription scene;
  scene.bodies.push_back(body_at("box", 1.0, Vec3d::Zero()));
  join(scene, "weld", "bolt", kGround, "box", Vec3d::Zero());
  JointDescription& other = join(scene, "spherical", "screw", kGround, "box", Vec3d(1.0, 0.0, 0.0));
  other.first_frame.point.z() += 0.1;
  const std::string text = refusal(scene);
  CAPTURE(text);
  CHECK(says(text, "'bolt'"));
  CHECK(says(text, "'screw'"));
}

TEST_CASE("a joint that would close only turned by half a turn is refused") {
  SceneDescription scene;
  scene.bodies.push_back(body_at("box", 1.0, Vec3d::Zero()));
  JointDescription& hinge = join(scene, "revolute", "hinge", kGround, "box", Vec3d::Zero());
  hinge.second_frame.axes = rotation_by(Vec3d(M_PI, 0.0, 0.0));
  CHECK(says(refusal(scene), "joint 'hinge': closes only with its axes turned by 180 deg"));
}

TEST_CASE("drivers whose rates contradict a fixed body are refused") {
  SceneDescription scene;
  scene.bodies.push_back(body_at("box", 1.0, Vec3d::Zero()));
  join(scene, "revolute", "hinge", kGround, "box", Vec3d::Zero());
  join(scene, "weld", "bolt", kGround, "box", Vec3d::Zero());
  Curve::Piece ramp;
  ramp.coefficients = {0.0, 1.0, 0.0, 0.0, 0.0, 0.0};
  scene.drivers.push_back({"turn", {"hinge", "angle"}, Curve({ramp})});
  CHECK(says(refusal(scene), "rates contradict each other"));
}

TEST_CASE("redundant joints: rank, names and marks") {
  // A planar loop of n revolutes constrains 3 motions out of plane twice.
  const auto two = compile(parallelogram(2)), three = compile(parallelogram(3));
  CHECK(two->redundant);
  CHECK(two->rows() == 20);
  CHECK(two->assembly.rank == 17);
  CHECK(three->rows() == 30);
  CHECK(three->assembly.rank == 23);
  CHECK(two->assembly.redundant.size() == 4);
  CHECK(three->assembly.redundant.size() == 6);
  SceneDescription scene = parallelogram(2);
  scene.bodies.push_back(body_at("lamp", 0.1, Vec3d(1.3, 0.0, 0.3)));
  join(scene, "spherical", "hook", "coupler", "lamp", Vec3d(1.3, 0.0, 0.8));
  const auto hung = compile(scene);
  for (const auto& e : hung->elements) CHECK(e.unique_reaction == (e.name == "hook"));
}

TEST_CASE("both orientations start from the same poses") {
  SceneDescription scene = slider_crank();
  scene.bodies[1].quaternion = quaternion_from_rotation(rotation_by(Vec3d(0.1, -0.05, 0.02)));
  const auto a = compile(scene);
  scene.orientation = Orientation::euler_xyz;
  const auto b = compile(scene);
  CHECK(a->assembly.residual_before > 0.01);
  for (int i = 0; i < a->body_count(); ++i) {
    const Mat3d r = rotation_from_quaternion<double>(
        view<4>(&a->initial_state[static_cast<std::size_t>(a->layout.pose(i) + 3)]));
    const Mat3d e = rotation_from_euler_xyz<double>(
        view<3>(&b->initial_state[static_cast<std::size_t>(b->layout.pose(i) + 3)]));
    // Newton's path differs at second order of the correction, and with it the point it ends in.
    CHECK((r - e).norm() < 0.02);
  }
  CHECK(b->assembly.residual_after < 1e-12);
}

}  // namespace seacrane::test
