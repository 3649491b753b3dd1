#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "seacrane/elements/loads/line_description.hpp"
#include "seacrane/elements/loads/line_friction.hpp"
#include "seacrane/elements/loads/margin.hpp"

namespace seacrane {

/// A line without mass over an ordered path of points and sheaves. With l the length of the path (LinePath),
/// l0 the unstretched length and e = l / l0 - 1,
///
///   T = max(0, EA e + c (l' - l0' l / l0)),   c = 2 damping_ratio sqrt(EA mass / l0),
///
/// the same along all of it without friction, else its mean (SheaveFriction). A table takes the place of EA e
/// (LineElasticity). The forces are -T dl.
///
/// l0 is given over time, or it is a state of the winch, which feels the tension of the first section and
/// measures the mean. Of a line with mass its first segment has the winch, and every segment a share of what
/// that pays out. The rope carries its strain energy T e / 2 for each metre of l0 onto the drum.
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
    PathSection<T> only;  // of a path between two points, which is laid once for all that asks for it
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

  Description d;
  LinePath path;
  std::vector<int> on;  // bodies of the path, each once, the last of the path last
  LineElasticity elasticity;
  bool has_sheaves = false, has_friction = false;
  double viscous = 0.0;  // c sqrt(l0)
  int settled = 0;       // w among the states
  int place = -1;        // among the inertial tensions; none: its stretch is not quasi-static
  double hung = 0.0;     // mass, kg
  std::optional<Winch> winch;
  std::shared_ptr<const Line> segment;  // on the winch of the line with mass; null: none, or this one
  StateRange states;                    // those of the winch; of a quasi-static stretch w

  static void check(const Description& d, const Check& c, SceneNames& names) {
    if (d.winch) names.input(c, kind, d.winch_name());
    d.check(c, names, kMostMargins - own_margins(d.winch) + 2);
  }
  static Description example() { return Description::example(); }

  template <class Context>
  static Line compile(const Description& d, Context& context) {
    Line line;
    line.d = d;
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
    line.elasticity = {d.EA, d.strains, d.tensions};
    line.hang(line.given_mass() ? d.mass : mass_of_ends(d, context));
    if (d.winch) {
      line.wind(context);
    } else if (!d.paid_out_by.empty()) {
      line.segment = segment_on(d.paid_out_by, Check(kind, d.name), context);
      for (const int b : line.segment->drives()) line.depend_on(b);
    }
    if (d.rung == kQuasiStatic) line.settle(context);
    if (d.winch && !d.paid_out_by.empty()) {
      Followed parts = line.winch->follows;
      parts.segment = std::make_shared<const Line>(line);
      context.lead(follows_as, d.paid_out_by, parts);
    }
    return line;
  }

  /// The segment on the winch of a line with mass, for a part of that line.
  template <class Context>
  static std::shared_ptr<const Line> segment_on(const std::string& winch, const Check& part,
                                                const Context& context) {
    std::shared_ptr<const Line> found = context.followed(kind, winch).segment;
    if (!found) {
      part.fail("is paid out by '" + winch +
                "', and no segment before it is on a winch of this name; add it");
    }
    return found;
  }

  /// Takes another mass for its damping, kg.
  void hang(double mass) {
    hung = mass;
    viscous = 2.0 * d.damping_ratio * std::sqrt(d.EA * hung);
  }

  const std::vector<int>& bodies() const { return on; }
  StateRange followed() const {
    if (segment) return segment->leading();
    return winch ? winch->follows.signal.states : StateRange{};
  }

  /// Of a line on a winch: the bodies, and the states and what is between them, on which the acceleration of
  /// what the winch pays out depends.
  std::vector<int> drives() const {
    const bool feels = winch->follows.any() || winch->tension || winch->drum;
    return feels ? on : std::vector<int>();
  }
  StateRange leading() const {
    const StateRange other = winch->follows.signal.states;
    if (other.count == 0) return states;
    const int first = std::min(states.first, other.first);
    return {first, std::max(states.first + states.count, other.first + other.count) - first};
  }
  /// That acceleration, of all that is paid out, where the winch has a lag, m/s2.
  template <class T>
  T winch_acceleration(const LoadInput<T>& in) const {
    if (!winch->tension && !winch->drum) return winch->asked_acceleration(in, T(0));
    const Motion<T> now = winch->drum ? motion(in) : movement(in);
    const T asked = winch->asked_acceleration(in, now.elastic);
    return winch->drum ? winch->drum->acceleration(in, asked, now.first(), winch->turning(in, now.elastic))
                       : asked;
  }

  bool quasi_static() const { return place >= 0; }
  bool given_mass() const { return d.mass > 0.0; }

  /// Jumps of the tension, with the stretch left out: of what drives l0, once for c, and once more often
  /// integrated for EA, once less for an inertial tension.
  std::vector<LoadKinks> kinks() const {
    const Winch* const by = paying_out();
    const int later = by ? by->integrations() : 0;  // from the curve to l0
    std::vector<LoadKinks> all;
    for (const auto& [curve, factor] : by ? by->driven_by() : Winch::Drives{{&d.length, 1.0}}) {
      const double share = d.share * factor;
      LoadKinks& out = all.emplace_back();
      for (const CurveKink& kink : curve->kinks()) {
        const double l0 = d.length.at(by ? 0.0 : kink.time).value;
        LoadKink& of = out.emplace_back(LoadKink{kink.time, Eigen::Matrix<double, 1, 4>::Zero()});
        const auto add = [&](int order, double factor) {
          for (int p = 1; p <= 3; ++p) {
            const int derivative = p - 1 - order;
            if (derivative >= 0 && derivative <= 3) of.jump(0, p) += factor * kink.jump(idx(derivative));
          }
        };
        add(later, share * d.EA / l0);
        add(later - 1, share * (damper(l0) + (quasi_static() ? d.EA * d.settling / l0 : 0.0)));
        if (quasi_static()) add(later - 2, share * hung / (1.0 + hung * l0 / strain_inertia()));
      }
    }
    return all;
  }

  void add_unit(int /*component*/, const LoadInput<double>& in, Vec6d* wrenches) const {
    for_each_share_of<double>(in, movement(in), 1.0,
                              [&](const Section<double>& s, double share, const SheaveFriction<double>&,
                                  std::size_t) { s.add_to(wrenches, share); });
  }

  /// Whether it is quasi-static and, on a side, neither taut nor free to haul in.
  bool slack(const Side& at) const { return quasi_static() && (at[kPushes] || at[kShort] || ended(at)); }
  /// Why a run cannot go on at a side; empty: it can.
  std::string refused(const Side& at) const {
    const std::string what = "line '" + d.name + "': ";
    for (std::size_t i = 1; has_sheaves && i + 1 < path.points().size(); ++i) {
      if (at[own_margins(winch.has_value()) + i - 1]) return what + SheaveDescriptions::lost(i);
    }
    const std::string ends = !ended(at)   ? ""
                             : at[kAtEnd] ? "has hauled in to its minimum_length"
                                          : "has paid out to its maximum_length";
    if (winch && !d.paid_out_by.empty() && ended(at)) {
      return what + "it " + ends + ", which would stop the mass of the line at once; " +
             "stop its winch before, or give another one";
    }
    if (!slack(at)) return "";
    const std::string stretch = what + "its stretch is quasi-static, and it ";
    if (!at[kPushes]) return stretch + ends + "; give another one, or rung 'elastic'";
    return stretch + "goes slack; give it rung 'elastic', which snatches";
  }

  /// A slack line may snatch; one on a winch comes to its ends.
  Sight look(const LoadInput<double>& in) const {
    Sight out{.side = margins(in).side()};
    const bool is_slack = out.side[kPushes] && out.side[kShort], winds = winch && !ended(out.side);
    if (!is_slack && !winds) return out;
    const Motion<double> now = motion(in);
    if (is_slack) {
      out.watched = side_of({kPushes, kShort});
      out.clear = std::max(0.0, -now.stretch());
      out.pace = std::abs(now.straining());
      out.strikes = true;
      out.at[0] = now.stretch();
    }
    if (!winds) return out;
    out.watched |= side_of({kAtEnd, kFull});
    out.pace = std::max(out.pace, std::abs(winch->rate(in, now.elastic)));
    out.at[1] = winch->length(in);
    out.clear = std::min(out.clear,
                         std::max(0.0, std::min(out.at[1] - d.minimum_length, d.maximum_length - out.at[1])));
    return out;
  }
  std::vector<std::string> reached(const Side& from, const Side& to) const {
    return winch ? bounds_met(d.winch_name(), kMargins, from, to) : std::vector<std::string>();
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
      out.tension = unbounded_pull(out) + d.EA * d.settling * unsettled + out.inertial;
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
    for_each_share_of<T>(in, now, now.tension, f);
  }
  /// The same of another mean tension.
  template <class T, class F>
  void for_each_share_of(const LoadInput<T>& in, const Motion<T>& now, const T& mean, F&& f) const {
    SheaveFriction<T> friction = friction_of(now);
    for_each_section<T>(in, now, [&](const Section<T>& s, std::size_t i) {
      const T tension = mean * now.share * friction.share();
      if (has_friction) friction.pass(s, path.points()[i]);
      f(s, tension, friction, i);
    });
  }

  /// EA s^2 e'' of a quasi-static stretch in this motion, for these accelerations of the bodies; null: zero.
  template <class T>
  T inertial_tension(const LoadInput<T>& in, const Motion<T>& now, const Vec6d* acceleration) const {
    T bend(0);  // l''
    for_each_section<T>(in, now, [&](const Section<T>& s, std::size_t i) {
      bend += s.rate_change(point_acceleration<T>(in, path.points()[i - 1], s.lever_first, acceleration),
                            point_acceleration<T>(in, path.points()[i], s.lever_second, acceleration),
                            turn_rate<T>(s.first, acceleration), turn_rate<T>(s.second, acceleration));
      if (s.turns) bend += path.swing<T>(in, i);
    });
    const T strain_rate = now.straining() / now.unstretched;
    const T driven = 2.0 * now.unstretched_rate * strain_rate +
                     now.length / now.unstretched * unstretched_acceleration(in, now);
    return strain_inertia() * (bend - driven) / now.unstretched;
  }
  void inertial(const LoadInput<double>& in, const Motion<double>& now, InertialTension& out) const {
    out.mass = strain_inertia() / now.unstretched;
    out.winding = now.power_per_inertial();
    out.still = inertial_tension<double>(in, now, nullptr);
    out.pulls.resize(2 * (path.points().size() - 1));
    for_each_share_of<double>(
        in, now, 1.0,
        [&](const Section<double>& s, double share, const SheaveFriction<double>&, std::size_t i) {
          auto &first = out.pulls[2 * i - 2], &second = out.pulls[2 * i - 1];
          first = {s.first, {}, share};
          second = {s.second, {}, share};
          s.add_to(first.path, second.path, 1.0);
        });
  }

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
      out.state_rates[settled] = (now.straining() / now.unstretched - in.states[settled]) / T(d.settling);
    }
    if (winch) winch->set_rates(in, now.elastic, now.first(), out.state_rates);
    if constexpr (std::is_same_v<T, double>) {
      if (quasi_static() && out.inertial) inertial(in, now, out.inertial[place]);
    }
  }

  double potential(const LoadInput<double>& in) const {
    const Motion<double> now = motion(in);
    const double strain = (now.stored + now.kinetic) * now.unstretched;
    return winch && winch->drum ? strain + winch->drum->stored(in, winch->turning(in, now.elastic)) : strain;
  }

  Margins margins(const LoadInput<double>& in) const {
    const Motion<double> now = motion(in);
    Margins out;
    out.add({nullptr, quasi_static() ? now.stretch() : unbounded_pull(now)});
    out.add({nullptr, now.stretch()});
    if (winch) {
      out.add({"minimum_length", winch->length(in) - d.minimum_length});
      out.add({"maximum_length", d.maximum_length - winch->length(in)});
      winch->add_margins(in, now.elastic, now.first(), out);
    }
    if (!has_sheaves) return out;
    for_each_section<double>(in, now, [&](const Section<double>& s, std::size_t i) {
      if (i + 1 < path.points().size()) out.add({nullptr, path.points()[i].radius == 0.0 ? 1.0 : s.hold});
    });
    return out;
  }

 private:
  /// Whether it pulls, whether it is stretched (damping pulls a little before, and lets go before), and, with
  /// a winch, whether it has reached neither end and what the winch meets. Sheaves follow.
  static constexpr std::size_t kPushes = 0, kShort = 1, kAtEnd = 2, kFull = 3;
  bool ended(const Side& at) const { return winch && (at[kAtEnd] || at[kFull]); }
  static constexpr auto kMargins = [] {
    std::array<Margin, 4 + Winch::kKinks> out;
    out[kAtEnd].bound = "minimum_length";
    out[kFull].bound = "maximum_length";
    std::copy(Winch::kMargins.begin(), Winch::kMargins.end(), out.begin() + 4);
    std::copy(Drum::kMargins.begin(), Drum::kMargins.end(), out.end() - Drum::kMargins.size());
    return out;
  }();
  static constexpr std::size_t own_margins(bool winds) { return winds ? kMargins.size() : 2; }

  template <class T>
  using Section = PathSection<T>;

  /// As LinePath does, of a motion.
  template <class T, class F>
  void for_each_section(const LoadInput<T>& in, const Motion<T>& now, F&& f) const {
    if (path.is_one_section()) return f(now.only, std::size_t{1});
    path.for_each_section<T>(in, f);
  }

  template <class Context>
  void wind(Context& context) {
    winch = Winch::compile(d, d.winch_name(), d.length.at(0.0).value / d.share, context);
    states = winch->states;
    if (winch->follows.any()) depend_on(winch->follows.signal.body);
  }
  void depend_on(int body) {
    if (std::find(on.begin(), on.end(), body) == on.end()) on.insert(on.begin(), body);
  }
  const Winch* paying_out() const { return winch ? &*winch : segment ? &*segment->winch : nullptr; }

  template <class Context>
  void settle(Context& context) {
    place = context.inertial_tension();
    const double scale = context.length_scale() / d.length.at(0.0).value;
    settled = context.state({d.name + ".strain_rate", "1/s", 0.0, scale});
    if (states.count == 0) states.first = settled;
    ++states.count;
  }
  double strain_inertia() const { return d.EA * d.settling * d.settling; }  // N s2

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
    if (!has_friction) return {};
    return {m.length, m.rate, m.unstretched, m.unstretched_rate, d.sheaves.slip_speed};
  }
  /// Lengths and rates, and how friction shares the tension; no tension yet.
  template <class T>
  Motion<T> movement(const LoadInput<T>& in) const {
    Motion<T> out{};
    if (path.is_one_section()) path.lay_only(in, out.only);
    for_each_section<T>(in, out, [&](const Section<T>& s, std::size_t) {
      out.length += s.length;
      out.rate += s.rate;
    });
    const CurveValue given = d.length.at(in.time, in.curve_limit);
    const Winch* const by = paying_out();
    out.unstretched = by ? T(d.share) * by->length(in) : T(given.value);
    out.elastic = select(quasi_static() || out.stretch() > T(0), elastic_pull(out), T(0));
    out.unstretched_rate = by ? T(d.share) * by->rate(in, out.elastic) : T(given.rate);
    out.share = T(1);
    if (!has_friction) return out;
    SheaveFriction<T> friction = friction_of(out);
    for_each_section<T>(in, out,
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
  static Vec3<T> turn_rate(int body, const Vec6d* acceleration) {
    if (!acceleration) return Vec3<T>::Zero();
    return acceleration[body].template tail<3>().template cast<T>();
  }
  template <class T>
  static Vec3<T> point_acceleration(const LoadInput<T>& in, const PathPoint& at, const Vec3<T>& lever,
                                    const Vec6d* acceleration) {
    Vec3<T> linear = Vec3<T>::Zero();
    if (acceleration) linear = acceleration[at.body].template head<3>().template cast<T>();
    if (at.at_state) return linear;
    const Vec3<T> angular = turn_rate<T>(at.body, acceleration);
    const Vec3<T>& omega = in.bodies[at.body].angular_velocity;
    return linear + cross<T>(angular, lever) + cross<T>(omega, cross<T>(omega, lever));
  }
  template <class T>
  T unstretched_acceleration(const LoadInput<T>& in, const Motion<T>& now) const {
    if (winch) return T(d.share) * winch->asked_acceleration(in, now.elastic);
    if (segment) return T(d.share) * segment->winch_acceleration(in);
    return T(d.length.at(in.time, in.curve_limit).acceleration);
  }
};

}  // namespace seacrane
