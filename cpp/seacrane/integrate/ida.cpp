#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <vector>

#include "seacrane/integrate/difference_jacobian.hpp"
#include "seacrane/integrate/registry.hpp"
#include "seacrane/integrate/sundials_integrator.hpp"

namespace seacrane {
namespace {

/// Factors of the wanted over the last step between which IDA keeps the last one: its own are 1 and 2.
constexpr double kNoSmaller = 1.0, kGrows = 2.0, kNeverGrows = 1e3;

/// Tolerances for the unknowns of the residual form. One value, or one per unknown, is taken as it is. One
/// per state component of the System is given to the differential unknowns in their order; the algebraic
/// ones get infinity here, and a size of their own at each restart.
std::vector<double> for_unknowns(const std::vector<double>& absolute, const ResidualSystem& residual,
                                 std::size_t state_size) {
  const std::span<const double> differential = residual.differential();
  if (absolute.size() == residual.size()) return absolute;
  if (absolute.size() != 1 && absolute.size() != state_size) {
    throw std::invalid_argument("absolute_tolerance holds " + std::to_string(absolute.size()) +
                                " values; give one, or one for each of the " + std::to_string(state_size) +
                                " state components");
  }
  std::vector<double> spread(residual.size(), std::numeric_limits<double>::infinity());
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

struct FreeIda {
  void operator()(void* memory) const { IDAFree(&memory); }
};

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
  Ida(System& system, ResidualSystem& residual, const IntegratorOptions& options)
      : SundialsIntegrator("ida", system, options, residual.size()),
        residual_(residual),
        norm_({options.relative_tolerance, for_unknowns(options.absolute_tolerance, residual, system.size())},
              residual.size()),
        n_(residual.size()),
        derivative_(n_),
        trial_(n_),
        trial_derivative_(n_),
        trial_residual_(n_),
        differential_(residual.differential().begin(), residual.differential().end()),
        dense_(n_),
        derivative_vector_(sundials::view(derivative_, context_)),
        differential_vector_(sundials::view(differential_, context_)),
        dense_vector_(sundials::view(dense_, context_)) {}

  int order() const override { return 5; }

 private:
  void restart() override;
  double advance(double t_limit) override;
  void dense_output(double t, double* y) const override;
  Counters solver_counters() const override;
  double attempted_step() const override;
  bool error_estimates(N_Vector errors, N_Vector weights) const override;
  void create();
  void size_multipliers();
  void hold_after_failure();
  void project(double t);
  double typical(std::size_t j) const;
  double multiplier_tolerance() const;
  int fill_weights(const double* y, double* w) const;
  int evaluate_residual(double t, const double* y, const double* ydot, double* r);
  int fill_jacobian(double t, double c, const double* y, const double* ydot, const double* r,
                    SUNMatrix matrix);

  static Ida& self(void* user_data) { return *static_cast<Ida*>(user_data); }
  static int residual(sunrealtype t, N_Vector y, N_Vector ydot, N_Vector r, void* user_data) {
    return self(user_data).evaluate_residual(t, sundials::data(y), sundials::data(ydot), sundials::data(r));
  }
  static int weigh(N_Vector y, N_Vector weights, void* user_data) {
    return self(user_data).fill_weights(sundials::data(y), sundials::data(weights));
  }
  static int jacobian(sunrealtype t, sunrealtype c, N_Vector y, N_Vector ydot, N_Vector r, SUNMatrix matrix,
                      void* user_data, N_Vector, N_Vector, N_Vector) {
    return self(user_data).fill_jacobian(t, c, sundials::data(y), sundials::data(ydot), sundials::data(r),
                                         matrix);
  }

  ResidualSystem& residual_;
  ErrorNorm norm_;
  std::size_t n_;
  double multiplier_size_ = 1.0;
  long failures_ = 0;  // of the error test since the last restart
  int held_ = 0;       // steps before the next may grow
  std::vector<double> derivative_, trial_, trial_derivative_, trial_residual_, differential_;
  // Written by dense_output(), which is const to the caller.
  mutable std::vector<double> dense_;
  sundials::Vector derivative_vector_, differential_vector_, dense_vector_;
  std::optional<sundials::DenseAlgebra> algebra_;
  std::unique_ptr<void, FreeIda> memory_;
};

void Ida::create() {
  memory_.reset(IDACreate(context_.get()));
  if (!memory_) throw std::runtime_error("ida: IDA could not be created");
  void* const memory = memory_.get();
  sundials::record_ida_messages(memory, messages_);
  require(IDAInit(memory, residual, time_, solution_vector_.get(), derivative_vector_.get()), "IDAInit");
  require(IDASetUserData(memory, this), "IDASetUserData");
  require(IDAWFtolerances(memory, weigh), "IDAWFtolerances");
  require(IDASetId(memory, differential_vector_.get()), "IDASetId");
  require(IDASetSuppressAlg(memory, SUNTRUE), "IDASetSuppressAlg");
  require(IDASetMaxStep(memory, options_.max_step), "IDASetMaxStep");
  require(IDASetInitStep(memory, options_.initial_step), "IDASetInitStep");
  algebra_.emplace(solution_vector_.get(), context_);
  require(IDASetLinearSolver(memory, algebra_->solver.get(), algebra_->matrix.get()), "IDASetLinearSolver");
  require(IDASetJacFn(memory, jacobian), "IDASetJacFn");
}

void Ida::restart() {
  residual_.expand(time_, state_.data(), solution_.data(), derivative_.data());
  size_multipliers();
  failures_ = held_ = 0;
  if (memory_) {
    require(IDAReInit(memory_.get(), time_, solution_vector_.get(), derivative_vector_.get()), "IDAReInit");
    return;
  }
  try {
    create();
  } catch (...) {
    memory_.reset();
    throw;
  }
}

void Ida::size_multipliers() {
  multiplier_size_ = 1.0;
  for (std::size_t i = 0; i < n_; ++i) {
    if (differential_[i] == 0.0) multiplier_size_ = std::max(multiplier_size_, std::abs(solution_[i]));
  }
}

/// Absolute tolerances alone say nothing of the size of multipliers: the tightest one's number then counts
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

int Ida::fill_weights(const double* y, double* w) const {
  norm_.weights(y, w);
  // Index 2: rounding of multipliers grows like 1 / h, while what they do to velocities shrinks like h.
  const double step = attempted_step(), rounding = 1e3 * std::numeric_limits<double>::epsilon();
  const double relative =
      std::max(multiplier_tolerance(), step > 0.0 ? std::min(1e-3, rounding / step) : 1e-3);
  for (std::size_t i = 0; i < n_; ++i) {
    if (differential_[i] == 0.0 && w[i] == 0.0) w[i] = 1.0 / (relative * (multiplier_size_ + std::abs(y[i])));
  }
  return 0;
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
  require(IDASetStopTime(memory_.get(), t_limit), "IDASetStopTime");
  double reached = time_;
  const int flag = IDASolve(memory_.get(), t_limit, &reached, solution_vector_.get(),
                            derivative_vector_.get(), IDA_ONE_STEP);
  if (flag < 0) fail("the implicit step");
  hold_after_failure();
  residual_.contract(reached, solution_.data(), state_.data());
  project(reached);
  return reached;
}

void Ida::hold_after_failure() {
  void* const memory = memory_.get();
  long failures = 0;
  int order = 1;
  IDAGetNumErrTestFails(memory, &failures);
  IDAGetLastOrder(memory, &order);
  held_ = failures > failures_ ? order + 2 : std::max(held_ - 1, 0);
  failures_ = failures;
  require(IDASetEtaFixedStepBounds(memory, kNoSmaller, held_ > 0 ? kNeverGrows : kGrows),
          "IDASetEtaFixedStepBounds");
}

void Ida::project(double t) {
  if (!system_.has_projection()) return;
  ++counters_.projections;
  system_.project(t, state_.data(), false);
  if (check_finite(state_.data(), size()) != 0) {
    messages_.last_error = "the projected state is not finite";
    fail("the projection");
  }
}

void Ida::dense_output(double t, double* y) const {
  if (IDAGetDky(memory_.get(), t, 0, dense_vector_.get()) < 0) fail("dense output");
  residual_.contract(t, dense_.data(), y);
}

Counters Ida::solver_counters() const {
  Counters now;
  IDAGetNumSteps(memory_.get(), &now.steps);
  IDAGetNumErrTestFails(memory_.get(), &now.rejected_steps);
  IDAGetNumNonlinSolvIters(memory_.get(), &now.newton_iterations);
  return now;
}

double Ida::attempted_step() const {
  double h = 0.0;
  IDAGetCurrentStep(memory_.get(), &h);
  return h;
}

bool Ida::error_estimates(N_Vector errors, N_Vector weights) const {
  return IDAGetEstLocalErrors(memory_.get(), errors) >= 0 && IDAGetErrWeights(memory_.get(), weights) >= 0;
}

}  // namespace

std::unique_ptr<Integrator> make_ida(System& system, ResidualSystem* residual,
                                     const IntegratorOptions& options) {
  if (residual == nullptr) {
    throw std::invalid_argument("integrator \"ida\" needs the residual form of the system");
  }
  return std::make_unique<Ida>(system, *residual, options);
}

}  // namespace seacrane
