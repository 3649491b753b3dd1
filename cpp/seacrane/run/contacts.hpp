#pragma once

#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "seacrane/run/stepper.hpp"

namespace seacrane {

constexpr double kTouch = 1e-10;  // m or rad: gaps below it are closed, and overlaps rounding
constexpr double kParted = 1e-9;  // m or rad: closed limits further open cannot all hold
constexpr double kStill = 1e-9;   // m/s or rad/s: rates that are rounding

enum class EventKind { contact, rebound, release, through };
const char* to_text(EventKind kind);

/// Events without end in no time.
class ChatteringError : public std::domain_error {
 public:
  using std::domain_error::domain_error;
};

/// A limit that began or ceased to hold, or a seat that what left it goes through.
struct Event {
  double time = 0.0;
  int limit = 0;
  EventKind kind = EventKind::contact;
  double speed = 0.0;        // m/s or rad/s: rate of approach just before; 0 for a release
  double impulse = 0.0;      // N s or N m s along the coordinate, positive as the limit can push
  double energy_lost = 0.0;  // J, of the whole impact; shared by limits hit at the same time
};

/// Finds and carries out what limits do: wires that go slack and snatch, stops that are hit and left, seats
/// that are lifted off.
///
/// Complementarity says which limits hold: side * gap >= 0 where one is open, side * multiplier >= 0
/// where it is closed. After every step the quantities that must not be negative are looked at, at the end of
/// the step and inside it; the first change of sign is located through the integrator's dense output. An
/// impact keeps momentum, M (v+ - v-) = D^T Lambda over all rows that hold, and each limit that is hit sends
/// its coordinate back at -restitution times the rate of approach (Newton). Where several limits are
/// involved, those whose impulse or multiplier would pull are let go, least index first (Murty's principal
/// pivoting), but by impulse only where something is faster than its sticking_speed. Limits that depend on
/// each other share their load as long as all of them push and their positions agree; where these contradict
/// each other the loosest goes slack, and where pivoting goes round in circles the least energy tells who
/// holds.
class Contacts {
 public:
  /// The stepper of a set: made when first asked for.
  using SetStepper = std::function<Stepper&(ClosedSet closed)>;

  Contacts(const Model& model, SetStepper stepper);

  /// Throws std::invalid_argument for a state that does not fit the limits of `at`.
  void check(Stepper& at, double t, const double* bodies) const;
  /// Time of the first event in the last step of `at`; nothing when there is none. Remembers its limit.
  std::optional<double> find(Stepper& at);
  /// Carries out the event found, at time t and the state `bodies` of the described bodies (on the joints of
  /// `closed`), and what follows from it at the same time. Work takes up what the impact changed. Returns the
  /// limits that hold from then on.
  ClosedSet carry_out(double t, double* bodies, ClosedSet closed);
  /// Finds the set that holds without an event: at the start.
  ClosedSet settle(double t, double* bodies, ClosedSet closed);
  /// Starts watching from the state (t, bodies) of `at`.
  void start(Stepper& at, double t, const double* bodies);

  /// Forces of all limits in the middle of the last step, then those at its end; zero of what does not hold.
  void read_forces(const Stepper& at, double* out) const;

  const std::vector<Event>& events() const { return events_; }
  double energy_lost() const { return energy_lost_; }
  /// Takes what the run before this one had lost, J.
  void continue_from(double energy_lost) { energy_lost_ = energy_lost; }

 private:
  struct Watched {
    double value = 0.0, rate = 0.0;
    double slack = 0.0;  // of a limit that holds
  };
  struct Dip {
    double part = 0.0;  // of the step; 0: none
    bool negative = false;
    double value = 0.0;
  };
  enum class Consistency { holds, changes, struck };
  /// What is hit at one time; `slow`: none of it faster than its sticking_speed.
  struct Struck {
    ClosedSet limits = 0;
    bool slow = true;
  };
  /// By limit, but for the changes of twist.
  struct Impact {
    std::vector<double> impulse, speed, lost;
    std::vector<bool> rebounds;
    std::vector<Vec6d> change;
    double driver_work = 0.0;
  };

  /// side * gap and its rate, with the kinematics that `terms` hold.
  Watched gap(const Limit& limit, const Terms& terms) const;
  /// What must not be negative, at (t, y) of the stepped form.
  double watched_value(Stepper& at, const Limit& limit, double t, const double* y);
  void evaluate(Stepper& at, double t, const double* bodies);
  static double slack(const Limit& limit, const Stepper& at);
  void watch(Stepper& at, double t, const double* bodies);
  void read_axes(const Stepper& at);
  void look_below_seats(Stepper& at, double t, bool stepped);
  void check_poles(double t) const;
  void look_inside(Stepper& at);
  Dip dip(Stepper& at, std::size_t limit) const;
  std::optional<double> locate_overlap(Stepper& at, std::size_t limit, double until, double value);
  double locate_parting(Stepper& at, std::size_t limit);
  std::optional<double> locate_change(Stepper& at, std::size_t limit);
  double locate(Stepper& at, std::size_t limit, double since, double until, double value, double level);
  Struck struck_with(Stepper& at, double t, const double* bodies, int found);
  std::optional<int> pulling(const Impact& impact, ClosedSet kept) const;
  bool is_dependent(Stepper& at, const Impact& impact, ClosedSet struck) const;
  ClosedSet end_impact(double t, double* bodies, const Impact& impact, ClosedSet closed, ClosedSet struck,
                       ClosedSet kept);
  Consistency consistency(const Stepper& at, int limit) const;
  ClosedSet hit(double t, double* bodies, ClosedSet closed, int found);
  ClosedSet release_loosest(double t, double* bodies, ClosedSet closed);
  ClosedSet settle_dependent(double t, double* bodies, ClosedSet closed);
  ClosedSet least_energy(double t, double* bodies, ClosedSet closed, ClosedSet seats);
  ClosedSet sharing(double t, const double* bodies, ClosedSet carry, ClosedSet idle);
  double amplification(Stepper& at, int limit, double impulse, double speed) const;
  void book(double* bodies, const std::vector<Vec6d>& change, double driver_work, double lost);
  Impact collide(Stepper& at, double t, const double* bodies, ClosedSet struck);
  void note(const Event& event);
  static std::string at_time(double t);
  [[noreturn]] void report_chatter(double t, int limit, const std::string& what) const;

  const Model& model_;
  SetStepper stepper_;
  std::vector<Event> events_;
  std::vector<double> instants_;  // of the events
  double energy_lost_ = 0.0;
  int found_ = 0;
  bool parted_ = false;  // found: limits that cannot all hold
  double last_pass_ = -1e300;
  std::size_t stalled_ = 0;              // passes in a row that took no time
  std::vector<Watched> before_, after_;  // by limit, at both ends of the last step
  std::vector<double> state_, probe_, bodies_, rate_;
  std::vector<double> middle_;     // forces of closed limits in the middle of the step
  std::vector<Vec3d> above_seat_;  // by limit: what left this seat, from its point
  std::vector<char> below_;        // by limit: what left this seat is under its plane
  bool watching_ = false;
  std::vector<Vec3d> axis_before_, axis_after_;  // the second body's x axis in the first's frame, likewise
};

}  // namespace seacrane
