#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <vector>

#include "seacrane/integrate/difference_jacobian.hpp"
#include "seacrane/integrate/registration.hpp"
#include "seacrane/integrate/sundials_integrator.hpp"

namespace seacrane {
namespace {

/// Factors of the wanted over the last step between which IDA keeps the last one: its own are 1 and 2.
constexpr double kNoSmaller = 1.0, kGrows = 2.0, kNeverGrows = 1e3;

/// At orders 1 and 2 the multipliers' share of short steps can hide what a higher order would bring: such
/// steps fail again and again, for ever, and the result is far from its tolerance. So many of them in a row,
/// of which more than one in so many failed, end the run.
constexpr int kLowOrder = 2;
constexpr long kMostLow = 20000, kOneFailedOf = 12;

/// Tolerances for the unknowns of the residual form. One value, or one per unknown, is taken as it is. One
/// per state component of the System is given to the differential unknowns in their order; the algebraic
/// ones get infinity here, and a size of their own at each restart.
std::vector<double> for_unknowns(const std::vector<double>& absolute, const ResidualSystem& residual,
                                 std::size_t state_size,
                                 double of_algebraic = std::numeric_limits<double>::infinity()) {
  const std::span<const double> differential = residual.differential();
  if (absolute.size() == residual.size()) return absolute;
  if (absolute.size() != 1 && absolute.size() != state_size) {
    throw std::invalid_argument("absolute_tolerance holds " + std::to_string(absolute.size()) +
                                " values; give one, or one for each of the " + std::to_string(state_size) +
                                " state components");
  }
  std::vector<double> spread(residual.size(), of_algebraic);
  std::size_t next = 0;
  for (std::size_t i = 0; i < spread.size(); ++i) {
    if (differential[i] == 0.0) continue;
    if (absolute.size() == 1) {
      spread[i] = absolute.front();
    } else if (next < absolute.size()) {
      spread[i] = absolute[next++];
    }
  }
  if (absolute.size() != 1 && next != absolute.size()) {
    throw std::invalid_argument(
        "absolute_tolerance is given per state component, but the residual form has another number of "
        "differential unknowns; give one value");
  }
  return spread;
}

std::vector<double> growth_of(const IntegratorOptions& options, const Problem& problem) {
  if (options.tolerance_growth.empty()) return {};
  return for_unknowns(options.tolerance_growth, *problem.residual, problem.system.size(), 0.0);
}

/// IDA: variable-order BDF on the residual form F(t, y, y') = 0, dense Jacobian F_y + c F_y', exact where the
/// system has one, else by difference quotients. Algebraic unknowns (multipliers) are kept out of the error
/// test, where index 2 would make them fail it at any step size; in the Newton iteration they count relative
/// to the largest of them.
///
/// The stabilised form keeps the constraints to the tolerance of the Newton iteration; state() is in
/// addition projected, as a copy that does not feed back.
///
/// A step that failed the error test is held before it may grow again, for as many steps as IDA wants to see
/// of equal length before it raises the order. Else order 1 is a trap: of equal steps it sees no error in
/// what it damps, the same in every step, so it doubles them, then sees the change, and halves them, for
/// ever.
class Ida final : public SundialsIntegrator {
 public:
  static constexpr IntegratorProperties properties{
      .name = "ida",
      .kind = "implicit multistep, SUNDIALS IDA, residual form",
      .order = 5,
      .lowest_order = 1,
      .dense_order = 0,
      .uses_jacobian = true,
      .residual_form = true,
      .restarts = true,
      .joints = "stabilised index 2 (Gear, Gupta, Leimkuhler)",
      .purpose = "a check of all others: other equations, solved by another program"};

  Ida(const Problem& problem, const IntegratorOptions& options)
      : SundialsIntegrator(
            properties, problem, options, sundials::ida,
            {options.relative_tolerance,
             for_unknowns(options.absolute_tolerance, *problem.residual, problem.system.size()), 1,
             growth_of(options, problem)},
            problem.residual->size()),
        residual_(*problem.residual),
        n_(residual_.size()),
        derivative_(n_),
        trial_(n_),
        trial_derivative_(n_),
        trial_residual_(n_),
        differential_(residual_.differential().begin(), residual_.differential().end()),
        derivative_vector_(sundials::view(derivative_, context_)),
        differential_vector_(sundials::view(differential_, context_)) {}

 private:
  void expand() override;
  void contract(double t, const std::vector<double>& unknowns, double* y) const override {
    residual_.contract(t, unknowns.data(), y);
  }
  void* make() override;
  void attach(void* memory) override;
  void reinitialise(void* memory) override;
  double advance(double t_limit) override;
  void fill_weights(const double* y, double* w) const override;
  void size_multipliers();
  void hold_after_failure();
  double typical(std::size_t j) const;
  double multiplier_tolerance() const;
  int evaluate_residual(double t, const double* y, const double* ydot, double* r);
  int fill_jacobian(double t, double c, const double* y, const double* ydot, const double* r,
                    SUNMatrix matrix);

  static Ida& own(void* user_data) { return static_cast<Ida&>(self(user_data)); }
  static int residual(sunrealtype t, N_Vector y, N_Vector ydot, N_Vector r, void* user_data) {
    return own(user_data).evaluate_residual(t, sundials::data(y), sundials::data(ydot), sundials::data(r));
  }
  static int jacobian(sunrealtype t, sunrealtype c, N_Vector y, N_Vector ydot, N_Vector r, SUNMatrix matrix,
                      void* user_data, N_Vector, N_Vector, N_Vector) {
    return own(user_data).fill_jacobian(t, c, sundials::data(y), sundials::data(ydot), sundials::data(r),
                                        matrix);
  }

  ResidualSystem& residual_;
  std::size_t n_;
  double multiplier_size_ = 1.0;
  long failures_ = 0;  // of the error test since the last restart
  int held_ = 0;       // steps before the next may grow
  long low_steps_ = 0, failures_before_low_ = 0;
  std::vector<double> derivative_, trial_, trial_derivative_, trial_residual_, differential_;
  sundials::Vector derivative_vector_, differential_vector_;
  std::optional<sundials::SparseAlgebra> algebra_;
};

void* Ida::make() {
  void* memory = IDACreate(context_.get());
  if (memory == nullptr) return nullptr;
  sundials::record_ida_messages(memory, messages_);
  if (IDAInit(memory, residual, time_, solution_vector_.get(), derivative_vector_.get()) < 0)
    IDAFree(&memory);
  return memory;
}

void Ida::attach(void* memory) {
  require(IDASetId(memory, differential_vector_.get()), "IDASetId");
  require(IDASetSuppressAlg(memory, SUNTRUE), "IDASetSuppressAlg");
  algebra_.emplace(solution_vector_.get(), context_);
  require(IDASetLinearSolver(memory, algebra_->solver.get(), algebra_->matrix.get()), "IDASetLinearSolver");
  require(IDASetJacFn(memory, jacobian), "IDASetJacFn");
}

void Ida::reinitialise(void* memory) {
  require(IDAReInit(memory, time_, solution_vector_.get(), derivative_vector_.get()), "IDAReInit");
}

void Ida::expand() {
  residual_.expand(time_, state_.data(), solution_.data(), derivative_.data());
  size_multipliers();
  failures_ = held_ = 0;
  low_steps_ = failures_before_low_ = 0;
}

void Ida::size_multipliers() {
  multiplier_size_ = 1.0;
  for (std::size_t i = 0; i < n_; ++i) {
    if (differential_[i] == 0.0) multiplier_size_ = std::max(multiplier_size_, std::abs(solution_[i]));
  }
}

/// Absolute tolerances alone say nothing about the size of multipliers: the tightest one's number then counts
/// relative to the largest multiplier.
double Ida::multiplier_tolerance() const {
  double tolerance = norm_.relative();
  if (!(tolerance > 0.0)) {
    tolerance = 1.0;
    for (const double value : options_.absolute_tolerance) {
      if (value > 0.0) tolerance = std::min(tolerance, value);
    }
  }
  return std::max(tolerance, std::numeric_limits<double>::epsilon());
}

void Ida::fill_weights(const double* y, double* w) const {
  norm_.weights(y, w);
  // Index 2: rounding of multipliers grows like 1 / h, while what they do to velocities shrinks like h.
  const double step = attempted_step(), rounding = 1e3 * std::numeric_limits<double>::epsilon();
  const double relative =
      std::max(multiplier_tolerance(), step > 0.0 ? std::min(1e-3, rounding / step) : 1e-3);
  for (std::size_t i = 0; i < n_; ++i) {
    if (differential_[i] == 0.0 && w[i] == 0.0) w[i] = 1.0 / (relative * (multiplier_size_ + std::abs(y[i])));
  }
}

double Ida::typical(std::size_t j) const {
  return differential_[j] == 0.0 ? multiplier_size_ : norm_.typical(j);
}

int Ida::evaluate_residual(double t, const double* y, const double* ydot, double* r) {
  return guarded([&] {
    ++counters_.evaluations;
    residual_.residual(t, y, ydot, r);
    return check_finite(r, n_);
  });
}

int Ida::fill_jacobian(double t, double c, const double* y, const double* ydot, const double* r,
                       SUNMatrix matrix) {
  ++counters_.jacobians;
  bool exact = false;
  const int failed = guarded([&] {
    double* const values = SUNDenseMatrix_Data(matrix);
    exact = residual_.jacobian(t, c, y, ydot, values) && all_finite(values, n_ * n_);
    if (exact) ++counters_.evaluations;
    return 0;
  });
  if (exact || failed != 0) return failed;
  const double h = attempted_step();
  std::copy_n(y, n_, trial_.data());
  std::copy_n(ydot, n_, trial_derivative_.data());
  for (std::size_t j = 0; j < n_; ++j) {
    const double increment = difference_increment(y[j], h * ydot[j], typical(j));
    trial_[j] = y[j] + increment;
    trial_derivative_[j] = ydot[j] + c * increment;
    const int flag = evaluate_residual(t, trial_.data(), trial_derivative_.data(), trial_residual_.data());
    if (flag != 0) return flag;
    trial_[j] = y[j];
    trial_derivative_[j] = ydot[j];
    double* const column = SUNDenseMatrix_Column(matrix, static_cast<sunindextype>(j));
    for (std::size_t i = 0; i < n_; ++i) column[i] = (trial_residual_[i] - r[i]) / increment;
  }
  return 0;
}

double Ida::advance(double t_limit) {
  require(solver_.set_stop_time(memory(), t_limit), "IDASetStopTime");
  double reached = time_;
  const int flag =
      IDASolve(memory(), t_limit, &reached, solution_vector_.get(), derivative_vector_.get(), IDA_ONE_STEP);
  if (flag < 0) fail("the implicit step");
  hold_after_failure();
  contract(reached, solution_, state_.data());
  project_state(reached);
  return reached;
}

void Ida::hold_after_failure() {
  long failures = 0;
  int order = 1;
  IDAGetNumErrTestFails(memory(), &failures);
  IDAGetLastOrder(memory(), &order);
  held_ = failures > failures_ ? order + 2 : std::max(held_ - 1, 0);
  failures_ = failures;
  if (order > kLowOrder) {
    low_steps_ = 0;
    failures_before_low_ = failures;
  } else if (++low_steps_ > kMostLow && kOneFailedOf * (failures - failures_before_low_) > low_steps_) {
    messages_.last_error = "its steps stay at order " + std::to_string(order) +
                           " and keep failing, and what they give is far from its tolerance: take dopri5, "
                           "rosenbrock or cvode-bdf for this scene, or ida with another rtol";
    fail("the implicit step");
  }
  require(IDASetEtaFixedStepBounds(memory(), kNoSmaller, held_ > 0 ? kNeverGrows : kGrows),
          "IDASetEtaFixedStepBounds");
}

}  // namespace

extern const Registration ida = registration<Ida>();

}  // namespace seacrane
