#pragma once

#include <memory>
#include <stdexcept>
#include <vector>

#include "seacrane/integrate/sundials_compat.hpp"

namespace seacrane::sundials {

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
struct FreeNonlinearSolver {
  void operator()(SUNNonlinearSolver solver) const { SUNNonlinSolFree(solver); }
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
using NonlinearSolver = std::unique_ptr<std::remove_pointer_t<SUNNonlinearSolver>, FreeNonlinearSolver>;

/// A SUNDIALS vector that looks at values kept elsewhere.
inline Vector view(std::vector<double>& values, const Context& context) {
  return Vector(N_VMake_Serial(static_cast<sunindextype>(values.size()), values.data(), context.get()));
}

inline double* data(N_Vector vector) { return N_VGetArrayPointer(vector); }

/// A dense matrix and the solver for it, of the size of `like`.
struct DenseAlgebra {
  DenseAlgebra(N_Vector like, const Context& context)
      : matrix(SUNDenseMatrix(N_VGetLength(like), N_VGetLength(like), context.get())),
        solver(SUNLinSol_Dense(like, matrix.get(), context.get())) {
    if (!matrix || !solver) throw std::runtime_error("SUNDIALS could not set up its dense linear solver");
  }
  Matrix matrix;
  LinearSolver solver;
};

}  // namespace seacrane::sundials
