#include <algorithm>
#include <limits>
#include <memory>
#include <stdexcept>
#include <vector>

#include "seacrane/integrate/registry.hpp"
#include "seacrane/integrate/sundials_integrator.hpp"

namespace seacrane {
namespace {

/// Step of the slow part without a choice of the user (s).
constexpr double default_step = 0.05;
constexpr int method_order = 3;
/// The pair that steps the fast part.
constexpr const char* fast_method = "dopri5";

/// The fast part with what MRIStep adds to it, a polynomial in (t - shift) / scale that stands for the slow
/// part.
class ForcedFastPart final : public System {
 public:
  explicit ForcedFastPart(System& system) : system_(system) {}

  std::size_t size() const override { return system_.size(); }
  void derivative(double t, const double* y, double* ydot) override {
    system_.fast_derivative(t, y, ydot);
    const double s = (t - shift_) / scale_;
    double power = 1.0;
    for (int k = 0; k < terms_; ++k, power *= s) {
      const double* const term = sundials::data(forcing_[k]);
      for (std::size_t i = 0; i < size(); ++i) ydot[i] += power * term[i];
    }
  }
  int take_forcing(MRIStepInnerStepper stepper) {
    return MRIStepInnerStepper_GetForcingData(stepper, &shift_, &scale_, &forcing_, &terms_);
  }

 private:
  System& system_;
  double shift_ = 0.0, scale_ = 1.0;
  N_Vector* forcing_ = nullptr;
  int terms_ = 0;
};

/// ARKODE's multirate stepper with the infinitesimal method MRI-GARK-ERK33a of order 3 [A. Sandu, A class of
/// multirate infinitesimal GARK methods, SIAM J. Numer. Anal. 57 (2019) 2300]: the slow part with a fixed
/// step, the fast part by a pair of our own with error control, to the tolerances of the run.
///
/// The split is made anew at the start of every step, after the projection, so ARKODE starts afresh there. An
/// evaluation at the raw end of the step, for dense output, is the start of the next one where projection
/// left the state alone.
class ArkodeMultirate final : public SundialsIntegrator {
 public:
  ArkodeMultirate(System& system, const IntegratorOptions& options);

  int order() const override { return method_order; }
  bool is_adaptive() const override { return false; }
  double step_in_use() const override { return length_; }

 private:
  struct Free {
    void operator()(void* memory) const { SEACRANE_MRI(Free)(&memory); }
  };

  void restart() override {}
  double advance(double t_limit) override;
  void dense_output(double t, double* y) const override;
  Counters solver_counters() const override { return {}; }
  double attempted_step() const override { return step_; }
  bool error_estimates(N_Vector, N_Vector) const override { return false; }

  void create();
  void start();
  void project(double t);
  int evaluate_whole(double t, const double* y);
  int evaluate_slow(double t, const double* y, double* ydot);
  int evaluate_fast(double t, const double* y, double* ydot);
  int evolve_fast(double t, double t_end, double* y);

  static ArkodeMultirate& self(void* user_data) { return *static_cast<ArkodeMultirate*>(user_data); }
  static ArkodeMultirate& self(MRIStepInnerStepper stepper) {
    void* content = nullptr;
    MRIStepInnerStepper_GetContent(stepper, &content);
    return self(content);
  }
  static int slow(sunrealtype t, N_Vector y, N_Vector ydot, void* user_data) {
    return self(user_data).evaluate_slow(t, sundials::data(y), sundials::data(ydot));
  }
  static int fast(MRIStepInnerStepper stepper, sunrealtype t, N_Vector y, N_Vector ydot, int /*mode*/) {
    return self(stepper).evaluate_fast(t, sundials::data(y), sundials::data(ydot));
  }
  static int evolve(MRIStepInnerStepper stepper, sunrealtype t, sunrealtype t_end, N_Vector y) {
    return self(stepper).evolve_fast(t, t_end, sundials::data(y));
  }
  static int keep(MRIStepInnerStepper, sunrealtype, N_Vector) { return 0; }

  double length_;
  double step_ = 0.0;
  /// f at the last (t, y) it was evaluated at.
  double whole_time_ = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> whole_state_, whole_, fast_;
  // Written by dense_output(), which is const to the caller.
  mutable std::vector<double> dense_;
  sundials::Vector dense_vector_;
  ForcedFastPart fast_part_;
  std::unique_ptr<Integrator> fast_integrator_;
  bool fast_started_ = false;
  sundials::InnerStepper inner_;
  std::unique_ptr<void, Free> memory_;
};

IntegratorOptions for_fast_part(const IntegratorOptions& options) {
  IntegratorOptions out;
  out.name = fast_method;
  out.relative_tolerance = options.relative_tolerance;
  out.absolute_tolerance = options.absolute_tolerance;
  return out;
}

ArkodeMultirate::ArkodeMultirate(System& system, const IntegratorOptions& options)
    : SundialsIntegrator("ark-mri", system, options, system.size()),
      length_(options.fixed_step > 0.0 ? options.fixed_step : default_step),
      whole_state_(size()),
      whole_(size()),
      fast_(size()),
      dense_(size()),
      dense_vector_(sundials::view(dense_, context_)),
      fast_part_(system),
      fast_integrator_(make_integrator(fast_part_, nullptr, for_fast_part(options))) {
  if (options.max_step > 0.0) length_ = std::min(length_, options.max_step);
}

void ArkodeMultirate::create() {
  MRIStepInnerStepper stepper = nullptr;
  require(MRIStepInnerStepper_Create(context_.get(), &stepper), "MRIStepInnerStepper_Create");
  inner_.reset(stepper);
  require(MRIStepInnerStepper_SetContent(stepper, this), "MRIStepInnerStepper_SetContent");
  require(MRIStepInnerStepper_SetEvolveFn(stepper, evolve), "MRIStepInnerStepper_SetEvolveFn");
  require(MRIStepInnerStepper_SetFullRhsFn(stepper, fast), "MRIStepInnerStepper_SetFullRhsFn");
  require(MRIStepInnerStepper_SetResetFn(stepper, keep), "MRIStepInnerStepper_SetResetFn");
  std::unique_ptr<void, Free> memory(
      MRIStepCreate(slow, nullptr, time_, solution_vector_.get(), stepper, context_.get()));
  if (!memory) throw std::runtime_error(name() + ": ARKODE could not be created");
  sundials::record_mri_messages(memory.get(), messages_);
  require(SEACRANE_MRI(SetUserData)(memory.get(), this), "SetUserData");
  const sundials::Coupling coupling(MRIStepCoupling_LoadTable(ARKODE_MRI_GARK_ERK33a));
  require(MRIStepSetCoupling(memory.get(), coupling.get()), "MRIStepSetCoupling");
  require(SEACRANE_MRI(SetInterpolantDegree)(memory.get(), 3), "SetInterpolantDegree");
  memory_ = std::move(memory);
}

/// Chooses the split at the present state, where ARKODE starts.
void ArkodeMultirate::start() {
  int flag = evaluate_whole(time_, state_.data());
  if (flag == 0) {
    flag = guarded([&] {
      system_.split(time_, state_.data());
      return 0;
    });
  }
  if (flag != 0) fail("the derivative at the start of the step");
  solution_ = state_;
  if (!memory_) {
    create();
  } else {
    require(MRIStepReInit(memory_.get(), slow, nullptr, time_, solution_vector_.get()), "MRIStepReInit");
  }
}

double ArkodeMultirate::advance(double t_limit) {
  const double remaining = t_limit - time_;
  step_ = limited_step(length_, remaining);
  const double t_end = step_ == remaining ? t_limit : time_ + step_;
  start();
  require(SEACRANE_MRI(SetFixedStep)(memory_.get(), t_end - time_), "SetFixedStep");
  require(SEACRANE_MRI(SetStopTime)(memory_.get(), t_end), "SetStopTime");
  double reached = time_;
  const int flag = SEACRANE_MRI(Evolve)(memory_.get(), t_end, solution_vector_.get(), &reached, ARK_ONE_STEP);
  if (flag < 0) fail("the step");
  if (check_finite(solution_.data(), size()) != 0) {
    messages_.last_error = "the solution is not finite; take a shorter fixed step";
    fail("the step");
  }
  state_ = solution_;
  project(t_end);
  ++counters_.steps;
  return t_end;
}

void ArkodeMultirate::project(double t) {
  if (!system_.has_projection()) return;
  ++counters_.projections;
  system_.project(t, state_.data(), false);
  if (check_finite(state_.data(), size()) == 0) return;
  messages_.last_error = "the projected state is not finite";
  fail("the projection");
}

void ArkodeMultirate::dense_output(double t, double* y) const {
  if (SEACRANE_MRI(GetDky)(memory_.get(), t, 0, dense_vector_.get()) < 0) fail("dense output");
  std::copy(dense_.begin(), dense_.end(), y);
}

int ArkodeMultirate::evaluate_whole(double t, const double* y) {
  whole_time_ = std::numeric_limits<double>::quiet_NaN();
  std::copy_n(y, size(), whole_state_.data());
  const int flag = evaluate(t, y, whole_.data());
  if (flag == 0) whole_time_ = t;
  return flag;
}

int ArkodeMultirate::evaluate_slow(double t, const double* y, double* ydot) {
  if (t != whole_time_ || !std::equal(y, y + size(), whole_state_.data())) {
    const int flag = evaluate_whole(t, y);
    if (flag != 0) return flag;
  }
  const int flag = evaluate_fast(t, y, fast_.data());
  for (std::size_t i = 0; i < size(); ++i) ydot[i] = whole_[i] - fast_[i];
  return flag;
}

int ArkodeMultirate::evaluate_fast(double t, const double* y, double* ydot) {
  return guarded([&] {
    ++counters_.fast_evaluations;
    system_.fast_derivative(t, y, ydot);
    return check_finite(ydot, size());
  });
}

int ArkodeMultirate::evolve_fast(double t, double t_end, double* y) {
  return guarded([&] {
    const int flag = fast_part_.take_forcing(inner_.get());
    if (flag != 0) return flag;
    const long before = fast_started_ ? fast_integrator_->counters().evaluations : 0;
    if (fast_started_) {
      fast_integrator_->reset(t, y);
    } else {
      fast_integrator_->init(t, y);
    }
    fast_started_ = true;
    try {
      while (fast_integrator_->time() < t_end) fast_integrator_->step(t_end);
    } catch (const IntegrationError& error) {
      throw IntegrationError(name(), error.time(), error.step_size(), error.component(),
                             "in the fast part: " + error.reason());
    }
    counters_.fast_evaluations += fast_integrator_->counters().evaluations - before;
    std::copy_n(fast_integrator_->state(), size(), y);
    return 0;
  });
}

}  // namespace

std::unique_ptr<Integrator> make_ark_mri(System& system, ResidualSystem* /*residual*/,
                                         const IntegratorOptions& options) {
  const std::string missing = system.missing_fast_part();
  if (!missing.empty()) {
    throw std::invalid_argument("integrator \"ark-mri\" steps a fast part of the system apart: " + missing +
                                "; choose another integrator");
  }
  return std::make_unique<ArkodeMultirate>(system, options);
}

}  // namespace seacrane
