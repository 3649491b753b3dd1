#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "seacrane/elements/field.hpp"
#include "seacrane/elements/loads/line_elasticity.hpp"
#include "seacrane/elements/loads/line_friction.hpp"
#include "seacrane/elements/loads/line_path.hpp"
#include "seacrane/elements/loads/line_sheaves.hpp"
#include "seacrane/elements/loads/load.hpp"
#include "seacrane/elements/loads/winch.hpp"
#include "seacrane/math/curve.hpp"
#include "seacrane/math/select.hpp"

namespace seacrane {

inline constexpr const char* kQuasiStatic = "quasi-static";

struct LineDescription : WinchDescription {
  std::string name;
  std::vector<std::string> bodies;
  std::vector<Vec3d> points;
  double EA = 0.0;
  Curve length;
  double damping_ratio = 0.02, mass = 0.0;
  std::string rung = "elastic";
  double settling = 0.2;
  SheaveDescriptions sheaves;
  std::vector<double> strains, tensions;

  static constexpr const char* type = "Line";
  static constexpr const char* text =
      "An elastic line without mass over points of bodies, with a winch or without; see Scene.add_line.";
  static constexpr auto fields() {
    using D = LineDescription;
    const auto own = std::tuple(
        on_body("bodies", &D::bodies, "bodies of the points, in the order of the path"),
        required("points", &D::points, "m", "coordinates of these bodies"),
        required("EA", &D::EA, "N", "axial stiffness: tension over strain").usually(0.0, 2e10),
        required("length", &D::length, "m", "unstretched; with a winch, at the start"),
        optional("damping_ratio", &D::damping_ratio, "", "of critical damping of `mass` on the line")
            .usually(1e-4, 1.0),
        optional("mass", &D::mass, "kg", "that bounces on the line; 0: what its start tells, see LineBounce"),
        optional("rung", &D::rung, "", "'elastic', or 'quasi-static': its stretch follows the tension"),
        optional("settling", &D::settling, "s", "in which a quasi-static stretch follows")
            .usually(1e-3, 10.0));
    const auto table = std::tuple(
        optional("strains", &D::strains, "", "from 0, of a table in place of EA").usually(0.0, 3.0),
        optional("tensions", &D::tensions, "N", "at these strains, from 0"));
    return std::tuple_cat(own, WinchDescription::fields(), sheave_fields<D>(), table);
  }
};

/// A line without mass over an ordered path of points and sheaves. With l the length of the path (LinePath),
/// l0 the unstretched length and e = l / l0 - 1,
///
///   T = max(0, EA e + c (l' - l0' l / l0)),   c = 2 damping_ratio sqrt(EA mass / l0),
///
/// the same along all of it without friction, else its mean (SheaveFriction). A table takes the place of EA e
/// (LineElasticity). The forces are -T dl.
///
/// l0 is given over time, or it is a state of the winch, which feels the tension of the first section and
/// measures the mean. The rope carries its strain energy T e / 2 for each metre of l0 onto the drum.
///
/// A quasi-static stretch follows the tension within a settling time s, whatever EA and the load's mass are:
///
///   T = EA (e + s (e' - w) + s^2 e'') + c l0 e',   w' = (e' - w) / s,
///
/// so that no mode is faster than 1 / s. Of slow motion p = d/dt the strain is T / EA but for 2 s^2 p^2, and
/// what is dissipated beside c, s^3 p^3. The part with e'' is an inertial tension: it depends on the
/// accelerations of the bodies, and is solved for with them (InertialTensions). Its store is half of
/// EA s^2 e'^2 l0.
struct Line {
  static constexpr const char* kind = "line";
  static constexpr const char* follows_as = "winch";
  using Description = LineDescription;

  /// What the line does at an instant.
  template <class T>
  struct Motion {
    T length, rate, unstretched, unstretched_rate, elastic, tension;
    T inertial, kinetic;  // N: of a quasi-static stretch, in the tension; stored for each metre
    T stored;             // J for each metre, by strain
    T share, lost;        // for 1 N: tension of the first section, and what sheaves take, W
    T stretch() const { return length - unstretched; }
    /// Rate of the stretch that strain alone would make: e' l0.
    T straining() const { return rate - unstretched_rate * length / unstretched; }
    T damping() const { return tension - elastic - inertial; }
    T first() const { return tension * share; }
    /// Into the line, of the winch and of what changes the length over time, but for the inertial tension.
    T winch_power() const {
      const T taken = (tension - inertial) * share * length / unstretched;
      return -(taken - stored - kinetic) * unstretched_rate;
    }
    /// The winch's power for an inertial tension of 1 N.
    T winch_power_per_inertial() const { return -share * length / unstretched * unstretched_rate; }
    T power_per_inertial() const { return winch_power_per_inertial() - lost; }
    T friction_power() const { return -lost * (tension - inertial); }
    T damping_power() const { return -damping() * straining(); }
  };

  std::string name;
  LinePath path;
  std::vector<int> on;  // bodies of the path, each once, the last of the path last
  double EA = 0.0;      // N
  LineElasticity elasticity;
  double slip_speed = 0.0;
  bool has_sheaves = false, has_friction = false;
  Curve length;
  double damping_ratio = 0.0, viscous = 0.0;  // the latter c sqrt(l0)
  double settling = 0.0;                      // s, of a quasi-static stretch; else zero
  int settled = 0;                            // w among the states
  int place = 0;                              // among the inertial tensions
  double hung = 0.0;                          // mass, kg
  bool given_mass = false;
  std::optional<Winch> winch;
  StateRange states;  // those of the winch; of a quasi-static stretch w

  static void check(const Description& d, const Check& c, SceneNames& names) {
    check_path(d, c, names);
    c.finite("EA", d.EA);
    if (!(d.EA > 0.0)) {
      c.fail("EA is " + to_text(d.EA) + " N; give the tension over the strain, positive");
    }
    for (const Curve::Piece& piece : d.length.pieces()) {
      const double start = d.length.at(piece.start).value;
      if (!(start > 0.0)) {
        c.fail("length is " + to_text(start) + " m at t = " + to_text(piece.start) +
               " s; an unstretched length must be positive");
      }
    }
    c.not_negative("damping_ratio", d.damping_ratio);
    c.not_negative("mass", d.mass);
    d.sheaves.check(d.points.size(), kSides - first_held(d.winch) + 2, c);
    d.sheaves.check_neighbours(d.bodies, d.points, c);
    LineElasticity::check(d.strains, d.tensions, c);
    check_rung(d, c);
    if (d.winch) {
      names.input(c, kind, d.name);
      Winch::check(d, d.length, c);
    } else if (d.rate.at(0.0).value != 0.0 || d.rate.pieces().size() > 1 || d.lag != 0.0) {
      c.fail("has a rate or a lag, and no winch; set winch, or leave them out");
    } else if (d.tension_gain != 0.0 || d.drum_inertia != 0.0) {
      c.fail("holds a tension or has a drum, and no winch; set winch, or leave them out");
    }
  }

  static Description example() {
    Description d;
    d.name = "load";
    d.bodies = {"first", "third", "second"};
    d.points = {{2.0, 0.5, -1.0}, {0.2, -0.4, 0.3}, {-1.0, 0.3, 2.0}};
    d.EA = 60.0;
    d.length = Curve::constant(3.0);
    d.damping_ratio = 0.1;
    d.winch = true;
    d.rate = Curve::quintic(0.0, 2.0, 0.1, 0.3);
    d.maximum_rate = 5.0;
    d.maximum_acceleration = 50.0;
    d.lag = 0.4;
    d.tension = Curve::constant(10.0);
    d.tension_gain = 0.01;
    d.dead_band = 1.0;
    d.drum_inertia = 2.0;
    d.drum_radius = 0.5;
    d.maximum_tension = 1e4;
    d.maximum_power = 1e5;
    d.brake = Curve::quintic(0.2, 1.2, 0.0, 1.0);
    d.brake_capacity = 30.0;
    d.brake_give = 0.5;
    d.sheaves.radii = {0.0, 0.2, 0.0};
    d.sheaves.axes = {{0.0, 0.0, 0.0}, {0.3, -1.0, 0.2}, {0.0, 0.0, 0.0}};
    d.sheaves.turns = {0.0, 1.0, 0.0};
    d.sheaves.efficiencies = {1.0, 0.9, 1.0};
    d.sheaves.frictions = {0.0, 0.02, 0.0};
    d.sheaves.slip_speed = 0.4;
    d.strains = {0.0, 0.5, 2.0, 9.0};
    d.tensions = {0.0, 20.0, 150.0, 900.0};
    return d;
  }

  template <class Context>
  static Line compile(const Description& d, Context& context) {
    Line line;
    line.name = d.name;
    std::vector<PathPoint> points;
    for (std::size_t i = 0; i < d.points.size(); ++i) {
      const Attachment at = context.attach(d.bodies[i], d.points[i]);
      points.push_back(d.sheaves.at(i, at));
      if (std::find(line.on.begin(), line.on.end(), at.body) == line.on.end()) line.on.push_back(at.body);
    }
    std::erase(line.on, points.back().body);
    line.on.push_back(points.back().body);
    line.path = LinePath(std::move(points));
    line.has_sheaves = d.sheaves.any();
    line.has_friction = line.path.has_friction();
    line.slip_speed = d.sheaves.slip_speed;
    line.EA = d.EA;
    line.elasticity = {d.EA, d.strains, d.tensions};
    line.length = d.length;
    line.damping_ratio = d.damping_ratio;
    line.given_mass = d.mass > 0.0;
    line.hang(line.given_mass ? d.mass : mass_of_ends(d, context));
    if (d.winch) line.wind(d, context);
    if (d.rung == kQuasiStatic) line.settle(d, context);
    return line;
  }

  /// Takes another mass for its damping, kg.
  void hang(double mass) {
    hung = mass;
    viscous = 2.0 * damping_ratio * std::sqrt(EA * hung);
  }

  const std::vector<int>& bodies() const { return on; }
  StateRange followed() const { return winch ? winch->follows.signal.states : StateRange{}; }

  bool quasi_static() const { return settling > 0.0; }

  /// Jumps of the tension, with the stretch left out: of what drives l0, once for c, and once more often
  /// integrated for EA, once less for an inertial tension.
  std::vector<LoadKinks> kinks() const {
    const int later = winch ? winch->integrations() : 0;  // from the curve to l0
    std::vector<LoadKinks> all;
    for (const auto& [curve, share] : winch ? winch->driven_by() : Winch::Drives{{&length, 1.0}}) {
      LoadKinks& out = all.emplace_back();
      for (const CurveKink& kink : curve->kinks()) {
        const double l0 = length.at(winch ? 0.0 : kink.time).value;
        LoadKink& of = out.emplace_back(LoadKink{kink.time, Eigen::Matrix<double, 1, 4>::Zero()});
        const auto add = [&](int order, double factor) {
          for (int p = 1; p <= 3; ++p) {
            const int derivative = p - 1 - order;
            if (derivative >= 0 && derivative <= 3) of.jump(0, p) += factor * kink.jump(idx(derivative));
          }
        };
        add(later, share * EA / l0);
        add(later - 1, share * (damper(l0) + EA * settling / l0));
        if (quasi_static()) add(later - 2, share * hung / (1.0 + hung * l0 / strain_inertia()));
      }
    }
    return all;
  }

  void add_unit(int /*component*/, const LoadInput<double>& in, Vec6d* wrenches) const {
    Motion<double> now = movement(in);
    now.tension = 1.0;
    for_each_tension<double>(
        in, now, [&](const Section<double>& s, double tension, const SheaveFriction<double>&, std::size_t) {
          s.add_to(wrenches, tension);
        });
  }
  /// By how much the path gets shorter along the twists of bodies: what a unit adds without friction.
  void add_path(const LoadInput<double>& in, Vec6d* wrenches) const {
    path.for_each_section<double>(in,
                                  [&](const Section<double>& s, std::size_t) { s.add_to(wrenches, 1.0); });
  }

  /// Whether it is quasi-static and, on a side, neither taut nor free to haul in.
  bool slack(int at) const { return quasi_static() && (at & kTaut) != kTaut; }
  /// Why a run cannot go on at a side; empty: it can.
  std::string refused(int at) const {
    const std::string what = "line '" + name + "': ";
    for (std::size_t i = 1; has_sheaves && i + 1 < path.points().size(); ++i) {
      if ((at & held(i)) == 0) return what + SheaveDescriptions::lost(i);
    }
    if (!slack(at)) return "";
    const std::string stretch = what + "its stretch is quasi-static, and it ";
    if (at & 1) return stretch + "has hauled in to its minimum_length; give a smaller one, or rung 'elastic'";
    return stretch + "goes slack; give it rung 'elastic', which snatches";
  }

  static bool has_sides() { return true; }
  /// A bit for each margin: of the line, and of the end of hauling in, where it is positive; of the winch,
  /// where it is not; and of each sheave, where the line is on it.
  int side(const LoadInput<double>& in) const {
    int out = 0;
    const Margins now = margins(in);
    for (std::size_t i = 0; i < now.size(); ++i) {
      if (winch || i <= kAtEnd) out |= (now[i] > 0.0) == (i <= kAtEnd) ? 1 << i : 0;
    }
    if (!has_sheaves) return out;
    path.for_each_section<double>(in, [&](const Section<double>& s, std::size_t i) {
      if (i + 1 < path.points().size() && (path.points()[i].radius == 0.0 || s.hold > 0.0)) out |= held(i);
    });
    return out;
  }
  /// The least of all margins that change, positive on the first side: so the first crossing is found.
  double across(const LoadInput<double>& in, int from, int to) const {
    const Margins now = margins(in);
    const int changed = from ^ to, sheaves = first_held(winch.has_value());
    double least = std::numeric_limits<double>::infinity();
    const auto see = [&](int bit, double margin, bool was_positive) {
      if ((changed & bit) != 0) least = std::min(least, was_positive ? margin : -margin);
    };
    for (int i = 0; i < sheaves; ++i) {
      see(1 << i, now[idx(i)], ((from >> i & 1) != 0) == (idx(i) <= kAtEnd));
    }
    if (changed >> sheaves == 0) return least;
    path.for_each_section<double>(in, [&](const Section<double>& s, std::size_t i) {
      if (i + 1 < path.points().size()) see(held(i), s.hold, (from & held(i)) != 0);
    });
    return least;
  }
  /// The bounds of the winch that are reached by a change of the side, such as "hoist.maximum_rate".
  std::vector<std::string> reached(int from, int to) const {
    std::vector<std::string> out;
    if (!winch) return out;
    if ((from & ~to) >> kAtEnd & 1) out.push_back(name + ".minimum_length");
    for (std::size_t i = 0; i < Winch::kKinks; ++i) {
      const int bit = 1 << (kAtEnd + 1 + i);
      if ((to & ~from & bit) != 0 && Winch::bound(i) != nullptr) out.push_back(name + "." + Winch::bound(i));
    }
    return out;
  }

  template <class T>
  Motion<T> motion(const LoadInput<T>& in) const {
    Motion<T> out = movement(in);
    const T strain = out.stretch() / out.unstretched;
    if (quasi_static()) {  // taut, or refused
      const T strain_rate = out.straining() / out.unstretched;
      out.inertial = T(in.inertial[place]);
      out.kinetic = 0.5 * strain_inertia() * strain_rate * strain_rate;
      const T unsettled = strain_rate - in.states[settled];
      out.tension = unbounded_pull(out) + EA * settling * unsettled + out.inertial;
      out.stored = elasticity.energy(strain);
      return out;
    }
    out.stored = select(strain > T(0), elasticity.energy(strain), T(0));
    const T sum = unbounded_pull(out);
    out.tension = select(sum > T(0), sum, T(0));
    return out;
  }

  /// Calls f(section, tension, friction, i) for each section; i as in LinePath, the friction being that of
  /// the sheaves up to the section's second end.
  template <class T, class F>
  void for_each_tension(const LoadInput<T>& in, const Motion<T>& now, F&& f) const {
    SheaveFriction<T> friction = friction_of(now);
    path.for_each_section<T>(in, [&](const Section<T>& s, std::size_t i) {
      const T tension = now.tension * now.share * friction.share();
      if (has_friction) friction.pass(s, path.points()[i]);
      f(s, tension, friction, i);
    });
  }

  /// EA s^2 e'' of a quasi-static stretch in this motion, for these accelerations of the bodies.
  template <class T>
  T inertial_tension(const LoadInput<T>& in, const Motion<T>& now, const Vec6d* acceleration) const {
    T bend(0);  // l''
    path.for_each_section<T>(in, [&](const Section<T>& s, std::size_t i) {
      bend += s.rate_change(point_acceleration<T>(in, s.first, s.lever_first, acceleration),
                            point_acceleration<T>(in, s.second, s.lever_second, acceleration),
                            acceleration[s.first].template tail<3>().template cast<T>(),
                            acceleration[s.second].template tail<3>().template cast<T>());
      if (s.turns) bend += path.swing<T>(in, i);
    });
    const T strain_rate = now.straining() / now.unstretched;
    const T driven = 2.0 * now.unstretched_rate * strain_rate +
                     now.length / now.unstretched * unstretched_acceleration(in, now);
    return strain_inertia() * (bend - driven) / now.unstretched;
  }
  /// By how much that falls for each m/s2 by which the path shortens faster.
  double inertial_mass(const Motion<double>& now) const { return strain_inertia() / now.unstretched; }

  /// What the winch's drum does.
  Drum::Drive drive(const LoadInput<double>& in) const {
    const Motion<double> now = motion(in);
    const double rate = winch->turning(in, now.elastic);
    const double motor =
        winch->drum->motor(in, winch->asked_acceleration(in, now.elastic), now.first(), rate);
    return {motor, winch->drum->braking(in, rate), rate, winch->drum->brake_power(in, rate)};
  }

  template <class T>
  void apply(const LoadInput<T>& in, LoadSum<T>& out) const {
    const Motion<T> now = motion(in);
    for_each_tension<T>(in, now,
                        [&](const Section<T>& s, const T& tension, const SheaveFriction<T>&, std::size_t) {
                          s.add_to(out.wrench, tension);
                        });
    out.add_power(now.damping_power());
    if (has_friction) out.add_power(now.friction_power());
    if (winch) {
      winch->add_power(in, now.elastic, now.first(), now.winch_power(), out);
    } else {
      out.add_power(now.winch_power());
    }
    if (quasi_static()) {
      out.add_power(now.power_per_inertial() * now.inertial);
      out.state_rates[settled] = (now.straining() / now.unstretched - in.states[settled]) / T(settling);
    }
    if (winch) winch->set_rates(in, now.elastic, now.first(), out.state_rates);
  }

  double potential(const LoadInput<double>& in) const {
    const Motion<double> now = motion(in);
    const double strain = (now.stored + now.kinetic) * now.unstretched;
    return winch && winch->drum ? strain + winch->drum->stored(in, winch->turning(in, now.elastic)) : strain;
  }

 private:
  static constexpr std::size_t kAtEnd = 2;
  static constexpr int kTaut = 1 + 2 + 4, kSides = 31;
  using Margins = std::array<double, kAtEnd + 1 + Winch::kKinks>;
  static constexpr double kJump = 1e-9;  // m and m/s

  template <class T>
  using Section = PathSection<T>;

  /// Number of the first bit of a side that tells of a sheave.
  static constexpr int first_held(bool winds) {
    return static_cast<int>(kAtEnd + 1 + (winds ? Winch::kKinks : 0));
  }
  int held(std::size_t point) const {
    return 1 << (first_held(winch.has_value()) + static_cast<int>(point) - 1);
  }

  static void check_path(const Description& d, const Check& c, SceneNames& names) {
    if (d.points.size() < 2 || d.points.size() != d.bodies.size()) {
      c.fail("has " + std::to_string(d.bodies.size()) + " bodies and " + std::to_string(d.points.size()) +
             " points; give as many of both, at least two");
    }
    for (std::size_t i = 0; i < d.points.size(); ++i) {
      names.body(c, d.bodies[i], true);
      c.near("points", d.points[i]);
      if (i > 0 && d.bodies[i] == d.bodies[i - 1] && d.points[i] == d.points[i - 1]) {
        c.fail("visits point " + std::to_string(i) + " twice in a row; leave one of them out");
      }
    }
    const auto other = [&](const std::string& name) { return name != d.bodies.front(); };
    if (std::none_of(d.bodies.begin(), d.bodies.end(), other)) {
      c.fail("has all its points on '" + d.bodies.front() + "', which it cannot move; name two bodies");
    }
  }

  static void check_rung(const Description& d, const Check& c) {
    if (d.rung != kQuasiStatic && d.rung != "elastic") {
      c.fail("rung '" + d.rung + "' is unknown; choose 'elastic' or 'quasi-static'");
    }
    c.finite("settling", d.settling);
    if (!(d.settling > 0.0)) c.fail("settling is " + to_text(d.settling) + " s; it must be positive");
    if (d.rung != kQuasiStatic) return;
    if (!d.strains.empty()) c.fail("a quasi-static stretch takes EA, no table; choose rung 'elastic'");
    if (d.winch && d.lag == 0.0) {
      c.fail(
          "a quasi-static stretch needs a smooth length, and its winch has no lag; give one, such as 0.1 s");
    }
    if (d.drum_inertia > 0.0) {
      c.fail("a drum with inertia rings with its line; choose rung 'elastic', or leave drum_inertia out");
    }
    for (const CurveKink& kink : d.length.kinks()) {
      if (kink.time <= 0.0 || std::abs(kink.jump(0)) + std::abs(kink.jump(1)) <= kJump) continue;
      c.fail("a quasi-static stretch needs a smooth length, and that given jumps at t = " +
             to_text(kink.time) + " s, or its rate; smooth it, or choose rung 'elastic'");
    }
  }

  template <class Context>
  void wind(const Description& d, Context& context) {
    winch = Winch::compile(d, d.name, d.length.at(0.0).value, context);
    states = winch->states;
    const int measured = winch->follows.signal.body;
    if (winch->follows.any() && std::find(on.begin(), on.end(), measured) == on.end()) {
      on.insert(on.begin(), measured);
    }
  }

  template <class Context>
  void settle(const Description& d, Context& context) {
    settling = d.settling;
    place = context.inertial_tension();
    const double scale = context.length_scale() / d.length.at(0.0).value;
    settled = context.state({d.name + ".strain_rate", "1/s", 0.0, scale});
    if (states.count == 0) states.first = settled;
    ++states.count;
  }
  double strain_inertia() const { return EA * settling * settling; }  // N s2

  /// The reduced mass of two bodies that the path joins, whichever way it is written.
  template <class Context>
  static double mass_of_ends(const Description& d, const Context& context) {
    const auto other = std::find_if(d.bodies.rbegin(), d.bodies.rend(),
                                    [&](const std::string& name) { return name != d.bodies.front(); });
    if (d.bodies.front() == kGround) return context.mass(*other);
    if (*other == kGround) return context.mass(d.bodies.front());
    const double first = context.mass(d.bodies.front()), second = context.mass(*other);
    return first * second / (first + second);
  }

  template <class T>
  SheaveFriction<T> friction_of(const Motion<T>& m) const {
    return {m.length, m.rate, m.unstretched, m.unstretched_rate, slip_speed};
  }
  /// Lengths and rates, and how friction shares the tension; no tension yet.
  template <class T>
  Motion<T> movement(const LoadInput<T>& in) const {
    Motion<T> out{};
    path.for_each_section<T>(in, [&](const Section<T>& s, std::size_t) {
      out.length += s.length;
      out.rate += s.rate;
    });
    const CurveValue given = length.at(in.time, in.curve_limit);
    out.unstretched = winch ? winch->length(in) : T(given.value);
    out.elastic = select(quasi_static() || out.stretch() > T(0), elastic_pull(out), T(0));
    out.unstretched_rate = winch ? winch->rate(in, out.elastic) : T(given.rate);
    out.share = T(1);
    if (!has_friction) return out;
    SheaveFriction<T> friction = friction_of(out);
    path.for_each_section<T>(in,
                             [&](const Section<T>& s, std::size_t i) { friction.pass(s, path.points()[i]); });
    out.share = out.length / friction.weight();
    out.lost = out.share * friction.lost();
    return out;
  }

  template <class T>
  T elastic_pull(const Motion<T>& m) const {
    return elasticity.tension(T(m.stretch() / m.unstretched));
  }
  template <class T>
  T unbounded_pull(const Motion<T>& m) const {
    return elastic_pull(m) + damper(m.unstretched) * m.straining();
  }
  /// c at an unstretched length.
  template <class T>
  T damper(const T& l0) const {
    using std::sqrt;
    return T(viscous) / T(sqrt(l0));
  }
  template <class T>
  static Vec3<T> point_acceleration(const LoadInput<T>& in, int body, const Vec3<T>& lever,
                                    const Vec6d* acceleration) {
    const Vec3<T> omega = in.bodies[body].angular_velocity;
    const Vec6<T> a = acceleration[body].template cast<T>();
    const Vec3<T> linear = a.template head<3>(), angular = a.template tail<3>();
    return linear + cross<T>(angular, lever) + cross<T>(omega, cross<T>(omega, lever));
  }
  /// Whether it pulls, whether it is stretched (damping pulls a little before, and lets go before), whether
  /// hauling in has not reached its end, and the kinks of the winch.
  Margins margins(const LoadInput<double>& in) const {
    const Motion<double> now = motion(in);
    Margins out;
    out.fill(1.0);
    out[0] = quasi_static() ? now.stretch() : unbounded_pull(now);
    out[1] = now.stretch();
    if (!winch) return out;
    out[kAtEnd] = winch->length(in) - winch->minimum_length;
    const auto of_winch = winch->margins(in, now.elastic, now.first());
    std::copy(of_winch.begin(), of_winch.end(), out.begin() + kAtEnd + 1);
    return out;
  }

  template <class T>
  T unstretched_acceleration(const LoadInput<T>& in, const Motion<T>& now) const {
    return winch ? winch->asked_acceleration(in, now.elastic)
                 : T(length.at(in.time, in.curve_limit).acceleration);
  }
};

}  // namespace seacrane
