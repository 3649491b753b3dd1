#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "seacrane/elements/loads/immersed_forces.hpp"
#include "seacrane/elements/loads/margin.hpp"
#include "seacrane/elements/loads/water_by_cause.hpp"
#include "seacrane/sea/sea_view.hpp"

namespace seacrane {

/// Water on a part of a body with frame at its centre P, its lowest point at a depth h below the surface at
/// P. With u the undisturbed flow, its mean over the part, v the velocity of P over it, A(h) the added mass
/// along the part's axes, V the volume that is wet,
///
///   F = rho V (Du/Dt + g e_z) - A (a - Du/Dt) - s A' h' v - (d/dt of A by turning) v - drag,
///   M = -v x (A v) and the moment of buoyancy,   s = 1 on entry (h' > 0), 0 on exit.
///
/// The added mass of a cylinder is the mean over its length of that of its circles, and each of them meets
/// the surface in its own plane: at a depth of its centre of s the surface is s / cos(inclination) away. So a
/// cylinder that lies has A(h) of a circle, an upright one as much as of its length is wet (Morison), and
/// each between has what its strips have, however many. The end of a cylinder, a disc, likewise: see
/// ImmersedAttitude.
///
/// Momentum A v is brought in on entry; half of |A' h'| v^2 goes with the jet, and as much remains in the
/// water on exit. The moment is Munk's (Kirchhoff's equations; H. Lamb, Hydrodynamics, art. 124).
///
/// The energies of the ledger are those of still water: v_b^T A v_b / 2 with the body's own velocity v_b, and
/// that of buoyancy at the depth; the power of the sea is what changes them.
struct ImmersedPart {
  static constexpr const char* kind = "immersed part";
  using Description = ImmersedPartDescription;
  using Shape = Description::Shape;

  Description d;
  ImmersedForces water;
  int body = 0;
  Vec3d point;              // from the state point, body axes
  Vec3d arm;                // the same in its own axes
  Vec3d first_point, step;  // of its row
  Mat3d axes;
  double edge = 0.0;  // m, by which edges are round: no attitude is singular
  int place_in_row = 0;
  StateRange states;             // what slam has taken, J
  Mat3d widths = Mat3d::Zero();  // columns: over which the flow is averaged, its axes
  int stencil = -1;              // its point in the sea

  static void check(const Description& d, const Check& c, SceneNames& names) { d.check(c, names); }
  static Description example() { return Description::example(); }

  template <class Context>
  static ImmersedPart compile(const Description& d, Context& context) {
    const Attachment on = context.attach(d.body, d.point);
    ImmersedPart out;
    out.d = d;
    out.body = on.body;
    out.point = on.point;
    out.first_point = snapped(context.attach(d.body, d.point - d.place * d.step).point);
    out.step = on.axes * d.step;
    out.place_in_row = static_cast<int>(d.place);
    out.axes = on.axes * d.axes;
    out.arm = out.axes.transpose() * out.point;
    const Shape shape = d.form();
    out.edge = (shape == Shape::box ? kRoundedShare : 0.1 * kRoundedShare) * 0.5 * d.size.maxCoeff();
    out.water = {.shape = shape,
                 .size = d.size,
                 .drag_factors = d.drag,
                 .whole = d.volume(),
                 .displaced = d.density * (d.fill * d.volume()),
                 .weight = d.density * context.gravity() * (d.fill * d.volume()),
                 .added = MonotoneSpline<3>(d.depths, d.added_masses),
                 .wet_volume = {}};
    if (d.is("table")) out.water.wet_volume = MonotoneSpline<1>(d.depths, d.volume_rows());
    if (d.is("table") && out.water.whole == 0.0) {  // it is wet, and braked, by its height
      using One = Eigen::Matrix<double, 1, 1>;
      out.water.wet_volume = MonotoneSpline<1>({0.0, d.size[2]}, {One(0.0), One(1.0)});
      out.water.whole = 1.0;
    }
    const double largest = d.added_masses.back().maxCoeff();
    const double scale = (largest > 0.0 ? largest : 1.0) * context.length_scale();  // at 1 m/s
    const Vec3d size = d.widths();
    out.widths = size.asDiagonal();
    out.stencil = context.stencil({.name = "immersed part '" + (d.row.empty() ? d.name : d.row) + "'",
                                   .count = static_cast<std::size_t>(d.count),
                                   .waves = d.wave_factor,
                                   .reach = 0.5 * ((d.count - 1.0) * d.step.norm() + size.norm()),
                                   .width = size.maxCoeff()});
    out.states = {context.state({d.name + ".slam_loss", "J", 0.0, scale}), 1};
    return out;
  }

  static std::vector<LoadKinks> kinks() { return {}; }

  std::array<int, 1> bodies() const { return {body}; }

  /// What strips of a row have in common; and where the sea is asked for.
  template <class T>
  struct Shared : ImmersedRow<T> {
    FlowPlace<T> first;  // of the row, and what comes from strip to strip
    Vec3<T> step;
    std::span<const LocalFlow<double>> row;  // of a double, where a wave reaches it

    using ImmersedRow<T>::ImmersedRow;
  };

  bool shares(const ImmersedPart& other) const {
    return stencil == other.stencil && body == other.body && axes == other.axes && step == other.step &&
           water.alike(other.water);
  }

  template <class T>
  Shared<T> shared(const LoadInput<T>& in) const {
    using std::sqrt;
    const auto& k = in.bodies[body];
    const Mat3<T> own = times<T>(k.rotation, axes);
    Shared<T> out(ImmersedAttitude<T>(water.shape, d.size, edge, own, k.angular_velocity), k);
    out.first = {k.position + times<T>(k.rotation, first_point), times<T>(own, widths), k.angular_velocity,
                 T(0)};
    out.first.height =
        sqrt(out.first.extents.row(2).squaredNorm() + T(edge * edge));  // plates have slopes too
    out.step = times<T>(k.rotation, step);
    if constexpr (std::is_same_v<T, double>) {
      const double last = out.first.position.z() + (d.count - 1.0) * out.step.z();
      if (std::min(out.first.position.z(), last) - out.lie.below < in.sea->crest(stencil))
        out.row = in.sea->row(stencil, in.time, out.first, out.step);
    }
    return out;
  }

  template <class T>
  void add_inertia(const LoadInput<T>& in, Shared<T>& as) const {
    meet(in, as, [&](const LocalFlow<T>* flow) { water.add_inertia(arm, flow, as); });
  }
  template <class T>
  void put(const Shared<T>& as, Mat6<T>* mass) const {
    as.mass.add_to(as.lie.axes, mass[body]);
  }
  template <class T>
  void add_inertia(const LoadInput<T>& in, Mat6<T>* mass) const {
    Shared<T> as = shared(in);
    add_inertia(in, as);
    put(as, mass);
  }
  /// Of all that share, most of them side by side.
  static void add_inertia(std::span<const ImmersedPart> row, const LoadInput<double>& in, Mat6d* mass);
  static void apply(std::span<const ImmersedPart> row, const LoadInput<double>& in, LoadSum<double>& out);

  template <class T>
  void apply(const LoadInput<T>& in, Shared<T>& as, LoadSum<T>& out) const {
    meet(in, as,
         [&](const LocalFlow<T>* flow) { out.state_rates[states.first] = water.apply(arm, flow, as, out); });
  }
  /// Buoyancy is the gradient of its energy: it also turns.
  template <class T>
  void put(const Shared<T>& as, LoadSum<T>& out) const {
    const ImmersedAttitude<T>& lie = as.lie;
    BodyLoad<T>& to = out.wrench[body];
    const Vec3<T> lever = times<T>(lie.axes, as.lifted);
    Vec3<T> moment(lever.y(), -lever.x(), T(0));
    const auto turn = [&](int i, const T& over_cosine) {  // times axis x e_z
      moment[0] -= over_cosine * lie.axes(1, i);
      moment[1] += over_cosine * lie.axes(0, i);
    };
    const auto slope = [&](int i, int axis) -> T {
      const double width = 0.5 * d.size[i];
      return as.over_width[i] * T(width * width) * lie.axes(2, axis) / lie.half[i];
    };
    if (water.shape == Shape::box) {
      for (int i = 0; i < 3; ++i) turn(i, slope(i, i));
    } else if (water.shape == Shape::cylinder) {
      turn(0, slope(0, 0) - slope(1, 0));
    }
    to.force += times<T>(lie.axes, as.force);
    to.force[2] += as.lift;
    to.moment += times<T>(lie.axes, as.moment) + moment;
  }
  template <class T>
  void apply(const LoadInput<T>& in, LoadSum<T>& out) const {
    Shared<T> as = shared(in);
    apply(in, as, out);
    put(as, out);
  }

  /// By cause, with an acceleration of its body (state point, inertial axes).
  WaterByCause by_cause(const LoadInput<double>& in, const Vec6d& acceleration) const {
    using Cause = WaterCause;
    const Seen seen = look_at(in);
    const Shared<double>& as = seen.as;
    const ImmersedForces::Place<double>& at = seen.at;
    const WetShare<double> wet = water.wet_share(as, at);
    const Mat3d& axes = as.lie.axes;
    WaterByCause out;
    const auto add = [&](Cause cause, const Vec3d& along) {
      out.force(cause) += axes * along;
      return along.dot(at.own);
    };
    if (wet.share > 0.0) {
      out.force(Cause::buoyancy).z() = water.weight * wet.share;
      out.power(Cause::waves) =
          water.weight * wet.share * at.rise + add(Cause::waves, at.pulled * (water.displaced * wet.share));
      out.power(Cause::drag) = add(Cause::drag, water.drag(at, wet));
    }
    if (!water.moves_water(as, at.center)) return out;
    const ImmersedForces::Added<double> here = water.added_at(as, at.center, at.rate);
    const ImmersedForces::Carried<double> moved = water.carried(as, at);
    const Vec3d driven = here.mass.cwiseProduct(at.pulled);
    const Vec3d slam = -here.gain.cwiseMax(0.0).cwiseProduct(at.velocity);
    const Vec3d turning = axes.transpose() * acceleration.tail<3>();
    const Vec3d accelerated = axes.transpose() * acceleration.head<3>() + turning.cross(arm);
    const Vec3d opposed = here.mass.cwiseProduct(accelerated);
    add(Cause::waves, driven);
    add(Cause::slam, slam);
    add(Cause::added_mass, moved.force - slam - driven - opposed);
    out.power(Cause::slam) = -moved.loss;
    out.power(Cause::waves) += moved.power + moved.loss;
    out.momentum = axes * here.mass.cwiseProduct(at.velocity);
    out.shed = -(axes * here.gain.cwiseMin(0.0).cwiseProduct(at.velocity));
    return out;
  }

  double potential(const LoadInput<double>& in) const {
    const Seen seen = look_at(in);
    const double depth = seen.at.depth;
    if (water.shape != Shape::table) return water.weight * water.wet_share(seen.as, seen.at).integral;
    return depth > 0.0 ? water.weight / water.whole * water.wet_volume.integral(depth)[0] : 0.0;
  }

  std::vector<std::string> reached(const Side& from, const Side& to) const {
    return bounds_met(d.name, std::array<Margin, 2>{{{"touch"}, {"awash"}}}, from, to);
  }
  Margins margins(const LoadInput<double>& in) const {
    const Seen seen = look_at(in);
    return Margins(
        std::array<Margin, 2>{{{"touch", -seen.at.depth}, {"awash", seen.as.lie.below - seen.at.center}}});
  }
  /// A part above all crests has these to come down to; others see the water where they are.
  Sight look(const LoadInput<double>& in) const {
    constexpr std::size_t touch = 0, awash = 1;  // as margins() has them
    const Margins margins = this->margins(in);
    const auto& k = in.bodies[body];
    Sight out{.side = margins.side(), .watched = side_of({touch, awash})};
    out.clear = margins.across(out.side, out.side ^ out.watched);
    out.at[0] = out.side[touch] ? -out.clear : out.clear;
    const double crest = in.sea->crest(stencil);
    if (!out.side[touch] && out.clear > crest) out.clear -= crest;
    out.pace = velocity_of(k, point).norm() + k.angular_velocity.norm() * d.size.norm();
    return out;
  }

 private:
  struct Seen {
    Shared<double> as;
    ImmersedForces::Place<double> at;
  };
  Seen look_at(const LoadInput<double>& in) const {
    Seen out{shared(in), {}};
    meet(in, out.as, [&](const LocalFlow<double>* flow) { out.at = water.place(out.as, arm, flow); });
    return out;
  }

  /// f(flow), or none where it is above all crests.
  template <class T, class F>
  void meet(const LoadInput<T>& in, const Shared<T>& as, F&& f) const {
    if constexpr (std::is_same_v<T, double>) {
      f(as.row.empty() ? nullptr : &as.row[idx(place_in_row)]);
    } else if (in.sea->field() && water.height(as, arm) - as.lie.below < T(in.sea->crest(stencil))) {
      const LocalFlow<T> flow = in.sea->template in_row<T>(stencil, place_in_row, in.time, as.first, as.step);
      f(&flow);
    } else {
      f(static_cast<const LocalFlow<T>*>(nullptr));
    }
  }

  /// Rounded, so that strips of a row agree on its first point to the last bit: the sea is then summed once.
  static Vec3d snapped(const Vec3d& point) {
    constexpr double grid = 0x1p-36;  // 1.5e-11 m
    return (point / grid).array().round() * grid;
  }
};

}  // namespace seacrane
