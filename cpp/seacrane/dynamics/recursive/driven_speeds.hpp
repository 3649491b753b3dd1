#pragma once

#include <optional>
#include <vector>

#include "seacrane/dynamics/recursive/articulated.hpp"
#include "seacrane/dynamics/recursive/driven_body.hpp"
#include "seacrane/dynamics/recursive/driven_stroke.hpp"

namespace seacrane {

/// Coordinates of a tree that drivers prescribe. They are functions of time alone and no unknowns: their
/// places in the state say only on which side of a dead centre a strut stands, and from which full turn on an
/// angle counts. Arrays of positions q and of speeds u are those of the tree.
class DrivenSpeeds {
 public:
  DrivenSpeeds(const Model& model, const BodyTree& tree);

  bool any() const { return !clusters_.empty(); }
  /// Clusters, by their place in the tree.
  const std::vector<std::size_t>& clusters() const { return clusters_; }

  /// Sets positions, speeds and rates of speeds. Throws std::domain_error where a stroke is out of its
  /// hinge's reach.
  void follow(double t, double curve_limit, double* q, double* u, double* u_rate);
  /// How speeds jump at t, from the left limit to that of `curve_limit`, where u are those before; elsewhere
  /// zero. Whether any does.
  bool jump(double t, double curve_limit, const double* q, const double* u, double* jump);
  /// What drives each coordinate by the tree's last solve(), along the tree's own.
  void read(const ArticulatedTree<double>& tree, std::vector<double>& drives) const;
  /// From these the load of a driver along its own coordinate, near positions q; not a number: of a driver of
  /// none of them.
  double force(int element, const std::vector<double>& drives, double t, double curve_limit,
               const double* q) const;
  /// Calls f(power) for every driver, by the tree's last solve() at the last follow().
  template <class T, class F>
  void for_each_power(const ArticulatedTree<T>& tree, F&& f) const;

 private:
  struct Coordinate {
    const Cluster* cluster;
    std::size_t place;
    const DriverData* driver;
    std::optional<DrivenStroke> stroke;
    double u = 0.0;  // at the last follow()
  };
  struct Body {
    const Cluster* cluster;
    std::size_t place;
    std::array<const DriverData*, 6> drivers;
    std::vector<Twist<double>> parts;  // six, at the last follow()
  };

  DrivenMotion motion(const Coordinate& one, double t, double curve_limit, double near) const;
  static DrivenBody motion(const Body& one, double t, double curve_limit);

  const Model& model_;
  std::vector<std::size_t> clusters_;
  std::vector<Coordinate> coordinates_;
  std::vector<Body> bodies_;
};

template <class T, class F>
void DrivenSpeeds::for_each_power(const ArticulatedTree<T>& tree, F&& f) const {
  for (const Coordinate& one : coordinates_) f(T(one.u) * tree.drive(one.place));
  for (const Body& one : bodies_) {
    const Wrench<T> wrench = tree.drive_wrench(one.place);
    for (const Twist<double>& part : one.parts) f(dot(Twist<T>(part.vector().cast<T>()), wrench));
  }
}

}  // namespace seacrane
