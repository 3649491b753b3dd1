#include "seacrane/model/merge.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "seacrane/elements/joints/prismatic.hpp"
#include "seacrane/elements/joints/revolute.hpp"
#include "seacrane/elements/joints/weld.hpp"
#include "seacrane/math/rotation.hpp"

namespace seacrane {
namespace {

class Merger {
 public:
  explicit Merger(const SceneDescription& scene)
      : scene_(scene), ground_(static_cast<int>(scene.bodies.size())), group_(idx(ground_) + 1) {
    index_[kGround] = ground_;
    for (int b = 0; b < ground_; ++b) index_[scene.bodies[idx(b)].name] = b;
    std::iota(group_.begin(), group_.end(), 0);
    anchored_.assign(group_.size(), false);
    anchored_.back() = true;
    for (const auto& v : scene.vessels) anchored_[idx(index_.at(v.body))] = true;
  }

  MergePlan run(const std::vector<RigidLink>& loops) {
    MergePlan plan;
    const auto locks = find_locks();
    for (const auto& joint : scene_.joints) {
      const auto lock = locks.find(joint.name);
      const bool locked = lock != locks.end();
      if ((joint.kind == Weld::kind && !joint.open) || locked) join(joint, locked ? lock->second : 0.0);
    }
    for (const RigidLink& loop : loops) join(loop);
    for (const auto& d : scene_.drivers) {
      if (same(joint_of(d))) plan.locked.push_back(d.name);
    }
    place(plan);
    return plan;
  }

 private:
  const JointDescription& joint_of(const DriverDescription& driver) const {
    return *std::find_if(scene_.joints.begin(), scene_.joints.end(),
                         [&](const auto& j) { return j.name == driver.coordinate.joint; });
  }

  /// Values at which a driver holds hinges and slides, by the joint's name.
  std::map<std::string, double> find_locks() const {
    std::map<std::string, double> out;
    for (const auto& d : scene_.drivers) {
      const JointDescription& joint = joint_of(d);
      if (joint.kind != Revolute::kind && joint.kind != Prismatic::kind) continue;
      if (const auto value = d.curve.constant_value()) out[joint.name] = *value;
    }
    return out;
  }

  int find(int b) const {
    while (group_[idx(b)] != b) b = group_[idx(b)];
    return b;
  }

  bool same(const JointDescription& joint) const {
    return find(index_.at(joint.first)) == find(index_.at(joint.second));
  }

  void join(const JointDescription& joint, double coordinate) {
    Mat3d turn = Mat3d::Identity();
    Vec3d slide = Vec3d::Zero();
    if (joint.kind == Revolute::kind)
      turn = rotation_about_z<double>(std::cos(coordinate), std::sin(coordinate));
    if (joint.kind == Prismatic::kind) slide.z() = coordinate;
    const Frame &f = joint.first_frame, &s = joint.second_frame;
    const Mat3d axes = f.axes * turn * s.axes.transpose();
    join({index_.at(joint.first), index_.at(joint.second), f.point + f.axes * slide - axes * s.point, axes});
  }

  void join(const RigidLink& link) {
    const int a = find(link.first), b = find(link.second);
    if (a == b || (anchored_[idx(a)] && anchored_[idx(b)])) return;
    group_[idx(b)] = a;
    if (anchored_[idx(b)]) anchored_[idx(a)] = true;
    links_.push_back(link);
  }

  /// The vessel or the ground of every group, else the body described first.
  std::vector<int> find_carriers() const {
    std::vector<int> carrier(group_.size(), -1);
    const auto claim = [&](int b) {
      int& place = carrier[idx(find(b))];
      if (place < 0) place = b;
    };
    for (const auto& v : scene_.vessels) claim(index_.at(v.body));
    claim(ground_);
    for (int b = 0; b < ground_; ++b) claim(b);
    return carrier;
  }

  void place(MergePlan& plan) const {
    const std::vector<int> carrier = find_carriers();
    std::vector<Placement> places(group_.size());
    std::vector<bool> placed(group_.size(), false);
    for (int b = 0; b < ground_; ++b) {
      if (carrier[idx(find(b))] != b) continue;
      places[idx(b)].body = static_cast<int>(plan.carriers.size());
      placed[idx(b)] = true;
      plan.carriers.push_back(b);
    }
    places.back().body = static_cast<int>(plan.carriers.size());
    placed.back() = true;
    for (bool going = true; going;) {
      going = false;
      for (const RigidLink& link : links_) going |= follow(link, places, placed);
    }
    places.pop_back();
    plan.places = std::move(places);
  }

  /// Places the end of a link whose other end is placed; whether it did.
  static bool follow(const RigidLink& link, std::vector<Placement>& places, std::vector<bool>& placed) {
    const auto a = idx(link.first), b = idx(link.second);
    if (placed[a] == placed[b]) return false;
    if (placed[a]) {
      places[b] = {places[a].body, places[a].point(link.origin), places[a].axes * link.axes};
    } else {
      const Mat3d axes = places[b].axes * link.axes.transpose();
      places[a] = {places[b].body, places[b].origin - axes * link.origin, axes};
    }
    placed[a] = placed[b] = true;
    return true;
  }

  const SceneDescription& scene_;
  const int ground_;
  std::map<std::string, int> index_;
  std::vector<int> group_;      // parent in its group, itself for the group's root
  std::vector<bool> anchored_;  // by root: holds a vessel or the ground
  std::vector<RigidLink> links_;
};

}  // namespace

MergePlan no_merge(const SceneDescription& scene) {
  MergePlan plan;
  for (int b = 0; b < static_cast<int>(scene.bodies.size()); ++b) {
    plan.places.push_back({b});
    plan.carriers.push_back(b);
  }
  return plan;
}

MergePlan plan_merge(const SceneDescription& scene, const std::vector<RigidLink>& loops) {
  MergePlan plan = paper_vessel(scene) ? no_merge(scene) : Merger(scene).run(loops);
  return plan.carriers.empty() ? no_merge(scene) : plan;
}

}  // namespace seacrane
