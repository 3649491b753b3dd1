#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "seacrane/elements/loads/entrapped_water_description.hpp"
#include "seacrane/elements/loads/load.hpp"
#include "seacrane/elements/loads/margin.hpp"
#include "seacrane/math/dual.hpp"
#include "seacrane/math/select.hpp"
#include "seacrane/sea/sea_view.hpp"

namespace seacrane {

/// Water in a prism along the z axis n of a body, of section A and height H, from its bottom at b. Its volume
/// V is a state. Heads are pressures over the atmosphere's / (density g). Through each opening, with z_o its
/// elevation,
///
///   q = C_d A_o sqrt(2 g) dh / (dh^2 + e^2)^(1/4),   dh = h_o - max(z_w - z_o, 0) - h_a
///
/// comes in, with h_o the head of the undisturbed sea there, none in air, z_w the elevation of the middle of
/// the surface inside, at b + n V / A, and h_a the head of the air above it. e rounds the root off. What
/// comes in is water where the opening is wet outside, what goes out where it is wet inside; else it is air,
/// by the same law with its density. V' is the sum of q of water, held within 0 and A H. A level surface that
/// meets walls alone is at z_w at any heel.
///
/// Air that is free has h_a = 0. Vented, it is as much as comes in: the sum of all q is zero, which h_a
/// follows from. Shut in, p (A H - V)^exponent stays, as long as no air passes; else it is as vented air,
/// or as much as the last opening holds back that lets it through.
/// Where all openings are in air outside and under water inside, nothing seals: air comes up through the
/// water. The mass of air is a state, its volume at one atmosphere. h_a is not below the vapour's pressure:
/// there a column of water parts from its lid. Without air, h_a is the head under the lid, likewise.
///
/// The water moves with the body as a rod on the axis, from the bottom to V / A; of its inertia along the
/// axis only the share s counts that an end carries: the bottom less its openings, or, once it is full, the
/// lid less its own. An opening in an end has no plate for dh to press on, which takes density g dh A_o from
/// the weight of all water and the buoyancy of a closed shape. A slice comes and goes at the upper end of the
/// rod: what comes in with a velocity u takes -density q (v - u) there, and what leaves has the velocity v
/// that it had; along the axis d(s V)/dV of it. So no inertia of flow along the axis.
///
/// Of its power, water that comes in brings g times the elevation outside and u^2 / 2. What is left of the
/// first over z_w + h_a, and (v - u)^2 / 2, are lost in its jet; both end as heat in the same eddies, in one
/// state, as does what air loses. Work on the air leaves the mechanical energy.
struct EntrappedWater {
  static constexpr const char* kind = "entrapped water";
  using Description = EntrappedWaterDescription;
  static constexpr double kRoundedHead = 1e-3;  // m, e
  /// Of e: a level at which as much time has gone by as Torricelli's law takes to none, from any head above.
  static constexpr double kFilm = 0.17387212574195163;
  static constexpr double kUpright = 0.8660254037844386;  // cosine of 30 deg
  static constexpr double kAtmosphere = 101325.0;         // Pa
  static constexpr double kVapour = 2339.0;               // Pa, of water at 20 deg C
  static constexpr double kAirDensity = 1.204;            // kg/m3, at 20 deg C
  static constexpr double kEvenOut = 0.05;                // s, in which the mass of air follows what is open
  static constexpr double kLeastSlab = 0.01;              // of the height, over which a lid takes water up

  enum class Air { free, vented, shut };
  struct Opening {
    Vec3d point;  // from the state point, body axes
    double area = 0.0;
    int stencil = -1;  // its point in the sea
    int end = 0;       // -1 in the bottom, 1 in the lid
  };

  Description d;
  Air air = Air::free;
  int body = 0;
  Vec3d point, axis;  // of the bottom, from the state point; body axes
  std::vector<Opening> openings;
  double gravity = 0.0, per_gravity = 0.0;      // m/s2; 1 over it, 0 where there is none
  StateRange states;                            // volume; what is lost, J; air that is shut in
  double bottom_share = 1.0, full_share = 1.0;  // of the water, carried along the axis
  double slab = 0.0;                            // m3 below full, over which the lid takes it up

  static void check(const Description& d, const Check& c, SceneNames& names) { d.check(c, names); }
  static Description example() { return Description::example(); }

  template <class Context>
  static EntrappedWater compile(const Description& d, Context& context) {
    const Attachment on = context.attach(d.body, d.point);
    EntrappedWater out;
    out.d = d;
    out.air = d.air == "shut" ? Air::shut : d.air == "vented" ? Air::vented : Air::free;
    out.body = on.body;
    out.point = on.point;
    out.axis = on.axes.col(2);
    for (std::size_t i = 0; i < d.opening_points.size(); ++i) {
      const std::string name = "opening " + std::to_string(i + 1) + " of entrapped water '" + d.name + "'";
      out.openings.push_back({context.attach(d.body, d.opening_points[i]).point, d.opening_areas[i],
                              context.stencil({.name = name, .waves = d.wave_factor, .reach = 0.0}),
                              d.end_of(i)});
    }
    out.set_shares();
    out.gravity = context.gravity();
    out.per_gravity = out.gravity > 0.0 ? 1.0 / out.gravity : 0.0;
    const double scale = context.length_scale() * d.area;
    const double lifted = d.density * (out.gravity > 0.0 ? out.gravity : 1.0) * d.height;
    out.states = {context.state({d.name + ".volume", "m3", d.initial, scale}), 2};
    context.state({d.name + ".flow_loss", "J", 0.0, lifted * scale});
    if (out.air == Air::shut) {
      const double ratio = d.air_pressure / kAtmosphere;
      const double first = (d.whole() - d.initial) * std::pow(ratio, 1.0 / d.exponent);
      context.state({d.name + ".air", "m3", first, scale});
      out.states.count = 3;
    }
    return out;
  }

  static std::vector<LoadKinks> kinks() { return {}; }

  std::array<int, 1> bodies() const { return {body}; }

  template <class T>
  void add_inertia(const LoadInput<T>& in, Mat6<T>* mass) const {
    const Column<T> water = column(in);
    const Mat3<T> lever = skew<T>(water.center);
    Mat6<T>& to = mass[body];
    for (int i = 0; i < 3; ++i) to(i, i) += water.mass;
    to.template bottomLeftCorner<3, 3>() += lever * water.mass;
    to.template topRightCorner<3, 3>() -= lever * water.mass;
    to.template bottomRightCorner<3, 3>() += turning_inertia(water);
    Eigen::Matrix<T, 6, 1> along;
    along << water.axis, cross<T>(water.center, water.axis);
    to -= along * along.transpose() * water.loose;
  }

  template <class T>
  void apply(const LoadInput<T>& in, LoadSum<T>& out) const {
    const Column<T> water = column(in);
    const auto& k = in.bodies[body];
    const Vec3<T>& turning = k.angular_velocity;
    BodyLoad<T>& on = out.wrench[body];
    on.add(Vec3<T>(T(0), T(0), T(-gravity) * water.mass), water.center);
    const Vec3<T> inward = cross<T>(turning, cross<T>(turning, water.center));
    on.force -= inward * water.mass;
    on.moment -= cross<T>(turning, turning_inertia(water) * turning);
    const Vec3<T> at = k.velocity + cross<T>(turning, water.center);
    on.add(Vec3<T>(water.axis * (water.loose * water.axis.dot(inward))), water.center);
    out.add_power(-water.loose * water.axis.dot(at) * cross<T>(turning, water.axis).dot(at));
    const Exchange<T> flow = exchange(in, water);
    T loss(0);
    for (std::size_t i = 0; i < openings.size(); ++i) loss += take_up(in, water, flow, i, out);
    out.state_rates[states.first] = flow.rate;
    out.state_rates[states.first + 1] = loss;
    if (air == Air::shut) out.state_rates[states.first + 2] = air_rate(in, water, flow);
    out.add_power(-loss - T(d.density * gravity) * flow.head * flow.rate);
  }

  double potential(const LoadInput<double>& in) const {
    const Column<double> water = column(in);
    return gravity * water.mass * (in.bodies[body].position.z() + water.center.z());
  }

  std::vector<std::string> reached(const Side& from, const Side& to) const {
    return bounds_met(d.name, kMargins, from, to);
  }
  /// Openings, which the water outside comes to and leaves.
  Sight look(const LoadInput<double>& in) const {
    const auto dry = [](std::size_t i) { return kMargins.size() + 2 * i; };  // above the water outside
    const Margins margins = this->margins(in);
    const auto& k = in.bodies[body];
    Sight out{.side = margins.side(), .at = k.position};
    double crest = 0.0;
    for (std::size_t i = 0; i < openings.size(); ++i) {
      out.watched.set(dry(i));
      out.pace = std::max(out.pace, velocity_of(k, openings[i].point).norm());
      if (out.side[dry(i)]) crest = std::max(crest, in.sea->crest(openings[i].stencil));
    }
    if (out.watched.none()) return out;
    out.clear = margins.across(out.side, out.side ^ out.watched);
    if (out.clear > crest) out.clear -= crest;
    return out;
  }

  Margins margins(const LoadInput<double>& in) const {
    const auto& k = in.bodies[body];
    const Column<double> water = column(in);
    auto own = kMargins;
    own[0].value = d.whole() - water.volume;
    own[1].value = water.volume - d.area * kFilm * kRoundedHead;
    own[2].value = water.axis.z() - kUpright;
    own[3].value = water.volume;
    Margins out(own);
    for (const Opening& one : openings) {
      const Vec3d place = k.position + k.rotation * one.point;
      const double outside = flow_at(in, one.stencil, place).pressure * per_gravity;
      out.add({nullptr, outside - place.z()});
      out.add({nullptr, water.level - place.z()});
    }
    return out;
  }

 private:
  /// Events; and where the bottom is dry, beyond which nothing leaves.
  static constexpr std::array<Margin, 4> kMargins = {{{"full"}, {"empty"}, {"leans"}, {}}};

  /// The water, inertial axes.
  template <class T>
  struct Column {
    T volume, mass, height;
    Vec3<T> axis, center, top;  // levers from the state point
    T level;                    // elevation of its surface
    Vec3<T> velocity;           // of its upper end
    T loose;                    // mass of which nothing is carried along the axis
    T taken;                    // along the axis, of what comes in
    bool full;
  };
  /// What is on both sides of an opening, and what comes in.
  template <class T>
  struct Flow {
    T outside{0}, inside{0};  // heads there, without the air's
    bool wet_outside = false, wet_inside = false;
    T elevation{0};                      // to which the sea stands outside, the opening's own in air
    Vec3<T> velocity = Vec3<T>::Zero();  // of the sea there
    T head{0};                           // dh
    T rate{0};                           // m3/s, of water or air
    bool air = false;
  };
  template <class T>
  struct Exchange {
    std::array<Flow<T>, Description::kMostOpenings> flows;
    T head{0};  // h_a
    T rate{0};  // of the volume
    bool open = false;
  };

  template <class T>
  Column<T> column(const LoadInput<T>& in) const {
    const auto& k = in.bodies[body];
    Column<T> out;
    out.volume = in.states[states.first];
    out.mass = T(d.density) * out.volume;
    out.height = out.volume * T(1.0 / d.area);
    out.axis = k.rotation * axis.cast<T>();
    const Vec3<T> bottom = k.rotation * point.cast<T>();
    out.center = bottom + out.axis * (T(0.5) * out.height);
    out.top = bottom + out.axis * out.height;
    out.level = k.position.z() + out.top.z();
    out.velocity = k.velocity + cross<T>(k.angular_velocity, out.top);
    out.full = !(out.volume < T(d.whole()));
    // Carried: bottom_share of the volume, and more as the lid takes it up.
    const T into = clamped(T((out.volume - T(d.whole() - slab)) * T(1.0 / slab)), T(0), T(1));
    const T up = T(full_share - bottom_share) * into * into * (T(3) - T(2) * into);
    const T rising = T(6.0 * (full_share - bottom_share) / slab) * into * (T(1) - into);
    out.loose = out.mass * (T(1.0 - bottom_share) - up);
    out.taken = T(bottom_share) + up + out.volume * rising;
    return out;
  }

  /// Of a rod about the state point.
  template <class T>
  static Mat3<T> turning_inertia(const Column<T>& water) {
    const Mat3<T> lever = skew<T>(water.center), along = skew<T>(water.axis);
    const T own = water.mass * water.height * water.height * T(1.0 / 12.0);
    return -(lever * lever) * water.mass - (along * along) * own;
  }

  /// The sea at an opening.
  template <class T>
  LocalFlow<T> flow_at(const LoadInput<T>& in, int stencil, const Vec3<T>& place) const {
    if (!(place.z() < T(in.sea->crest(stencil)))) return {};  // above all crests there is none
    return in.sea->template at_point<T>(stencil, in.time, place);
  }

  double per_head() const { return per_gravity / d.density; }
  double lowest_head() const { return (kVapour - kAtmosphere) * per_head(); }

  /// What comes through an opening under the head of the air. Returns it over dh.
  template <class T>
  T pass(const Flow<T>& at, double area, const T& air_head, Flow<T>& out) const {
    using std::sqrt;
    out.head = at.outside - at.inside - air_head;
    out.air = out.head > T(0) ? !at.wet_outside : !at.wet_inside;
    const T size = sqrt(out.head * out.head + T(kRoundedHead * kRoundedHead));
    const double ratio = out.air ? d.density / kAirDensity : 1.0;
    const T unit = T(d.discharge_coefficient * area * std::sqrt(2.0 * gravity * ratio)) / sqrt(size);
    out.rate = unit * out.head;
    return unit;
  }

  /// Both sides of all openings.
  template <class T>
  void look(const LoadInput<T>& in, const Column<T>& water, Exchange<T>& out) const {
    const auto& k = in.bodies[body];
    for (std::size_t i = 0; i < openings.size(); ++i) {
      Flow<T>& at = out.flows[i];
      const Vec3<T> place = k.position + k.rotation * openings[i].point.cast<T>();
      const LocalFlow<T> sea = flow_at(in, openings[i].stencil, place);
      const T outside = sea.pressure * T(per_gravity);
      at.wet_outside = outside > place.z();
      at.wet_inside = water.full || water.level > place.z();
      at.elevation = select(at.wet_outside, outside, place.z());
      at.outside = at.elevation - place.z();
      at.inside = select(at.wet_inside, T(water.level - place.z()), T(0));
      at.velocity = sea.velocity;
    }
  }

  /// What all openings let in under the head of the air, and its slope in it.
  std::array<double, 2> let_in(const Exchange<double>& all, double air_head) const {
    std::array<double, 2> out{};
    for (std::size_t i = 0; i < openings.size(); ++i) {
      Flow<double> now;
      const double unit = pass(all.flows[i], openings[i].area, air_head, now);
      const double square = now.head * now.head, rounding = kRoundedHead * kRoundedHead;
      out[0] += now.rate;
      out[1] -= unit * (0.5 * square + rounding) / (square + rounding);
    }
    return out;
  }

  /// The head of air at which as much comes in as goes out: what all let in falls with it, so there is one.
  double balanced(const Exchange<double>& all) const {
    double low = all.flows[0].outside - all.flows[0].inside, high = low;
    for (std::size_t i = 1; i < openings.size(); ++i) {
      const double one = all.flows[i].outside - all.flows[i].inside;
      low = std::min(low, one);
      high = std::max(high, one);
    }
    double now = 0.5 * (low + high);
    for (int i = 0; i < kMostHalvings && low < high; ++i) {
      const auto [sum, slope] = let_in(all, now);
      if (sum == 0.0) break;
      (sum > 0.0 ? low : high) = now;
      const double next = now - sum / slope, last = now;
      now = next > low && next < high ? next : 0.5 * (low + high);
      if (std::abs(now - last) < 1e-15 * (1.0 + std::abs(now))) break;
    }
    return now;
  }
  /// With its slopes, by one step of Newton's method.
  template <class T>
  T balanced_head(const Exchange<T>& all) const {
    Exchange<double> plain;
    for (std::size_t i = 0; i < openings.size(); ++i) {
      const Flow<T>& from = all.flows[i];
      Flow<double>& to = plain.flows[i];
      to.outside = value_of(from.outside);
      to.inside = value_of(from.inside);
      to.wet_outside = from.wet_outside;
      to.wet_inside = from.wet_inside;
    }
    const double head = balanced(plain), slope = let_in(plain, head)[1];
    if constexpr (std::is_same_v<T, double>) {
      return head;
    } else {
      if (openings.size() == 1) return all.flows[0].outside - all.flows[0].inside;
      T sum(0);
      for (std::size_t i = 0; i < openings.size(); ++i) {
        Flow<T> now;
        pass(all.flows[i], openings[i].area, T(head), now);
        sum += now.rate;
      }
      return T(head) - (slope != 0.0 ? T(sum * T(1.0 / slope)) : T(0));
    }
  }

  /// Whether air that is shut in finds no way under a head: none beside it, below it, or by suction.
  template <class T>
  bool sealed(const Exchange<T>& all, const T& air_head) const {
    for (std::size_t i = 0; i < openings.size(); ++i) {
      const Flow<T>& at = all.flows[i];
      const T head = at.outside - at.inside - air_head;
      if (!at.wet_inside && (!at.wet_outside || head < T(0))) return false;
      if (!at.wet_outside && head > T(0)) return false;
    }
    return true;
  }
  /// The head at which the last opening stops to let air through: out below its lip, or in by suction.
  template <class T>
  T lip(const Exchange<T>& all, bool out) const {
    T found(0);
    bool any = false;
    for (std::size_t i = 0; i < openings.size(); ++i) {
      const Flow<T>& at = all.flows[i];
      if (out ? at.wet_inside : at.wet_outside) continue;
      const T one = at.outside - at.inside;
      if (!any || (out ? one < found : one > found)) found = one;
      any = true;
    }
    return found;
  }
  /// Whether there is water behind every opening, and none before.
  template <class T>
  bool falls_out(const Exchange<T>& all) const {
    return std::all_of(all.flows.begin(), all.flows.begin() + openings.size(),
                       [](const Flow<T>& at) { return !at.wet_outside && at.wet_inside; });
  }

  /// Of air that is shut in.
  template <class T>
  T kept_head(const LoadInput<T>& in, const Column<T>& water) const {
    const T& amount = in.states[states.first + 2];
    if (!(amount > T(0))) return T(lowest_head());
    const T ratio = power(T(amount / (T(d.whole()) - water.volume)), d.exponent);
    const T head = T(kAtmosphere * per_head()) * (ratio - T(1));
    return select(head > T(lowest_head()), head, T(lowest_head()));
  }

  /// The head of the air, or of the water under the lid where there is none.
  template <class T>
  T air_head(const LoadInput<T>& in, const Column<T>& water, Exchange<T>& all) const {
    if (air == Air::free && !water.full) return T(0);
    const T lowest(lowest_head());
    if (air == Air::shut) {
      all.open = falls_out(all);
      if (all.open) return T(0);
      if (!water.full) {
        const T kept = kept_head(in, water);
        all.open = !sealed(all, kept);
        if (!all.open) return kept;
        const T even = balanced_head(all);
        return sealed(all, even) ? lip(all, kept > even) : select(even > lowest, even, lowest);
      }
    }
    const T least = air == Air::free ? T(0) : lowest, head = balanced_head(all);
    return select(head > least, head, least);
  }

  /// What comes in and goes out: full, it takes no more than it gives; dry, it gives no more than it takes.
  template <class T>
  Exchange<T> exchange(const LoadInput<T>& in, const Column<T>& water) const {
    Exchange<T> out;
    look(in, water, out);
    out.head = air_head(in, water, out);
    T into(0), from(0), gas(0);
    for (std::size_t i = 0; i < openings.size(); ++i) {
      Flow<T>& flow = out.flows[i];
      pass(flow, openings[i].area, out.head, flow);
      (flow.air ? gas : flow.rate > T(0) ? into : from) += flow.rate;
    }
    out.rate = into + from;
    if (water.full && out.rate > T(-kBalance) * into) {
      out.rate = T(0);
    } else if (!(water.volume > T(0)) && out.rate < T(0)) {
      const T share = -into / from;
      for (Flow<T>& flow : out.flows) {
        if (!flow.air && flow.rate < T(0)) flow.rate *= share;
      }
      out.rate = T(0);
    }
    return out;
  }

  /// Of the mass of air, as its volume at one atmosphere: what is open has that of its head.
  template <class T>
  T air_rate(const LoadInput<T>& in, const Column<T>& water, const Exchange<T>& flow) const {
    if (!flow.open || per_gravity == 0.0) return T(0);
    const T held = power(T(T(1) + flow.head * T(1.0 / (kAtmosphere * per_head()))), 1.0 / d.exponent);
    const T room = T(d.whole()) - water.volume;
    return (held * room - in.states[states.first + 2]) * T(1.0 / kEvenOut);
  }

  /// What goes through an opening does to the body and to the ledger. Returns the power that is lost.
  template <class T>
  T take_up(const LoadInput<T>& in, const Column<T>& water, const Exchange<T>& all, std::size_t i,
            LoadSum<T>& out) const {
    const Flow<T>& flow = all.flows[i];
    const T weight = T(d.density * gravity);
    if (const Opening& opening = openings[i]; opening.end != 0) {  // in an end, which no plate is in
      const auto& k = in.bodies[body];
      const Vec3<T> lever = k.rotation * opening.point.cast<T>();
      const T size = T(d.density * gravity * opening.area * opening.end) * flow.head;
      out.wrench[body].add(Vec3<T>(water.axis * size), lever);
      out.add_power(size * water.axis.dot(k.velocity + cross<T>(k.angular_velocity, lever)));
    }
    if (flow.air) {
      const T loss = weight * flow.rate * flow.head;
      out.add_power(loss);  // which the work on the air has in it already
      return loss;
    }
    const T mass = T(d.density) * flow.rate;
    const Vec3<T>& own = mass > T(0) ? flow.velocity : water.velocity;
    const Vec3<T> slip = water.velocity - own;
    const T along = water.axis.dot(slip), less = T(1) - water.taken, had = water.axis.dot(own);
    out.wrench[body].add(Vec3<T>((slip - water.axis * (less * along)) * T(-mass)), water.top);
    out.add_power(weight * flow.rate * flow.elevation +
                  T(0.5) * mass * (own.squaredNorm() - less * had * had));
    return weight * flow.rate * (flow.elevation - water.level - all.head) +
           T(0.5) * mass * (slip.squaredNorm() - less * along * along);
  }

  /// A lid takes water up over 3 H (C_d A_o / A)^2: so that the pressure under it begins as that of all that
  /// comes up through its openings.
  void set_shares() {
    const double lid = d.open_share(1), jet = d.discharge_coefficient * lid;
    bottom_share = std::max(0.0, 1.0 - d.open_share(-1));
    full_share = std::max(bottom_share, 1.0 - lid);
    slab = d.whole() * std::min(1.0, std::max(kLeastSlab, 3.0 * jet * jet));
  }

  static constexpr int kMostHalvings = 200;
  static constexpr double kBalance = 1e-6;  // of what comes in, to which it is found
};

}  // namespace seacrane
