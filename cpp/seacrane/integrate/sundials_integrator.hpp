#pragma once

#include <algorithm>
#include <exception>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "seacrane/integrate/integrator.hpp"
#include "seacrane/integrate/problem.hpp"
#include "seacrane/integrate/sparse_lu.hpp"
#include "seacrane/integrate/sundials_compat.hpp"

namespace seacrane {
namespace sundials {

struct FreeContext {
  void operator()(SUNContext context) const { SUNContext_Free(&context); }
};
struct FreeVector {
  void operator()(N_Vector vector) const { N_VDestroy(vector); }
};
struct FreeMatrix {
  void operator()(SUNMatrix matrix) const { SUNMatDestroy(matrix); }
};
struct FreeLinearSolver {
  void operator()(SUNLinearSolver solver) const { SUNLinSolFree(solver); }
};

/// The memory of a solver, freed by the solver's own function.
struct FreeMemory {
  void (*free)(void**);
  void operator()(void* memory) const { free(&memory); }
};

using Memory = std::unique_ptr<void, FreeMemory>;
using Context = std::unique_ptr<std::remove_pointer_t<SUNContext>, FreeContext>;
using Vector = std::unique_ptr<std::remove_pointer_t<N_Vector>, FreeVector>;
using Matrix = std::unique_ptr<std::remove_pointer_t<SUNMatrix>, FreeMatrix>;
using LinearSolver = std::unique_ptr<std::remove_pointer_t<SUNLinearSolver>, FreeLinearSolver>;

/// A SUNDIALS vector that looks at values kept elsewhere.
inline Vector view(std::vector<double>& values, const Context& context) {
  return Vector(N_VMake_Serial(static_cast<sunindextype>(values.size()), values.data(), context.get()));
}

inline double* data(N_Vector vector) { return N_VGetArrayPointer(vector); }

/// A matrix kept densely and a solver for it that skips its zeros, of the size of `like`.
class SparseAlgebra {
 public:
  SparseAlgebra(N_Vector like, const Context& context)
      : matrix(SUNDenseMatrix(N_VGetLength(like), N_VGetLength(like), context.get())),
        solver(SUNLinSolNewEmpty(context.get())),
        lu_(static_cast<std::size_t>(N_VGetLength(like))) {
    if (!matrix || !solver) throw std::runtime_error("SUNDIALS could not set up its linear solver");
    solver->content = &lu_;
    solver->ops->gettype = [](SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; };
    solver->ops->setup = [](SUNLinearSolver self, SUNMatrix a) {
      std::copy_n(SUNDenseMatrix_Data(a), SUNDenseMatrix_LData(a), lu(self).column(0));
      return lu(self).factor() ? 0 : 1;
    };
    solver->ops->solve = [](SUNLinearSolver self, SUNMatrix, N_Vector x, N_Vector b, sunrealtype) {
      std::copy_n(data(b), N_VGetLength(b), data(x));
      lu(self).solve(data(x));
      return 0;
    };
    solver->ops->free = [](SUNLinearSolver self) {
      SUNLinSolFreeEmpty(self);
      return 0;
    };
  }
  SparseAlgebra(const SparseAlgebra&) = delete;
  SparseAlgebra& operator=(const SparseAlgebra&) = delete;

  Matrix matrix;
  LinearSolver solver;

 private:
  static SparseLu& lu(SUNLinearSolver self) { return *static_cast<SparseLu*>(self->content); }

  SparseLu lu_;
};

}  // namespace sundials

/// What the SUNDIALS methods share: the solver's memory, hard stops, exceptions across C, messages, restarts,
/// dense output and counters.
///
/// Nothing may be thrown through the C code of the solvers. A callback runs inside guarded(), which keeps
/// an exception and tells the solver to give up; the step then throws it again. A result that is not
/// finite is reported to the solver as an error that a shorter step may cure.
class SundialsIntegrator : public Integrator {
 public:
  /// `tolerances` are those of the `unknowns` that the solver works on.
  SundialsIntegrator(const IntegratorProperties& properties, const Problem& problem,
                     const IntegratorOptions& options, const sundials::Solver& solver,
                     const Tolerances& tolerances, std::size_t unknowns);

  void init(double t0, const double* y0) final;
  void step(double t_limit) final;
  void interpolate(double t, double* y) const final;
  void reset(double t, const double* y) final;
  Counters counters() const final;
  double step_in_use() const final;
  double steps_lost_by_reset() const final { return 20.0; }
  std::vector<double> save() const final;
  void load(std::span<const double> saved) final;

 protected:
  /// Sets the unknowns from time_ and state_, and back.
  virtual void expand() { solution_ = state_; }
  virtual void contract(double /*t*/, const std::vector<double>& unknowns, double* y) const {
    std::copy(unknowns.begin(), unknowns.end(), y);
  }
  /// The solver's memory, at time_ and solution_; null when it cannot be made.
  virtual void* make() = 0;
  /// Chooses formulas and solvers for new memory.
  virtual void attach(void* memory) = 0;
  /// Makes the solver forget the past, at time_ and solution_.
  virtual void reinitialise(void* memory) = 0;
  /// One internal step. Fills state_ and returns the time reached, or returns through fail().
  virtual double advance(double t_limit) = 0;
  virtual void fill_weights(const double* y, double* w) const { norm_.weights(y, w); }

  void* memory() const { return memory_.get(); }
  double attempted_step() const;
  /// Projects state_, beside the solver.
  void project_state(double t);
  static SundialsIntegrator& self(void* user_data) { return *static_cast<SundialsIntegrator*>(user_data); }
  /// f for solvers of the explicit form.
  static int derivative(sunrealtype t, N_Vector y, N_Vector ydot, void* user_data);

  /// Throws the exception kept by guarded(), or an IntegrationError for a failed `call`.
  [[noreturn]] void fail(const std::string& call) const;
  /// Throws std::runtime_error when a set-up call of SUNDIALS returned a negative flag.
  void require(int flag, const char* call) const;

  template <class Work>
  int guarded(Work&& work) noexcept {
    try {
      return work();
    } catch (...) {
      pending_ = std::current_exception();
      return -1;
    }
  }
  /// f(t, y) for the solver's callbacks: 0, or 1 when the result is not finite.
  int evaluate(double t, const double* y, double* ydot);
  /// Jacobian of f at (t, y): the system's own, else by difference quotients; `slope` is f there. Our own
  /// quotients because those of the solvers take increments from the error weights, which are zero for
  /// components outside the error norm.
  static int dense_jacobian(sunrealtype t, N_Vector y, N_Vector slope, SUNMatrix matrix, void* user_data,
                            N_Vector, N_Vector, N_Vector);
  /// 0 when finite, else 1 with the component noted.
  int check_finite(const double* values, std::size_t size);

  System& system_;
  IntegratorOptions options_;
  const sundials::Solver& solver_;
  ErrorNorm norm_;
  sundials::MessageLog messages_;
  sundials::Context context_;
  // The solver's unknowns. Apart from state_, which a failed step must leave alone.
  std::vector<double> solution_;
  sundials::Vector solution_vector_;
  Counters counters_;
  // Taken out by fail(), also from dense output.
  mutable std::exception_ptr pending_;
  std::size_t bad_component_ = IntegrationError::no_component;

 private:
  void create();
  void restart();
  /// Steps, failed error tests, Newton iterations since the last restart(); evaluations are counted here.
  Counters solver_counters() const;
  std::size_t dominant_component() const;
  int fill_jacobian(double t, const double* y, const double* slope, double* columns);
  static int weigh(N_Vector y, N_Vector weights, void* user_data);

  sundials::Memory memory_;
  Counters before_restart_;
  std::vector<double> trial_, trial_slope_;  // of fill_jacobian()
  // Written by interpolate(), which is const to the caller.
  mutable std::vector<double> dense_;
  sundials::Vector dense_vector_;
  // Filled only to name the dominant component of a failure.
  mutable std::vector<double> errors_, weights_;
  sundials::Vector errors_vector_, weights_vector_;
  bool started_ = false;
  bool must_restart_ = true;
  double step_before_restart_ = 0.0;  // s: what a restarted solver starts with is shorter
  // The last step was too short for the solver: the state was carried over.
  bool carried_ = false;
};

}  // namespace seacrane
