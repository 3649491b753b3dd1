#pragma once

// The differences between the SUNDIALS releases 6.x and 7.x, and nothing else. Compiled and tested with
// 6.4; the branches for 7.x follow its documentation and headers and have not been compiled.

#include <cvode/cvode.h>
#include <cvode/cvode_ls.h>
#include <cvode/cvode_proj.h>
#include <ida/ida.h>
#include <ida/ida_ls.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_config.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_types.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <string>

#if SUNDIALS_VERSION_MAJOR < 6
#error "SUNDIALS 6.x or 7.x is needed"
#endif

namespace seacrane::sundials {

/// What a solver would have printed; the last error is the reason given in an IntegrationError.
struct MessageLog {
  std::string last_error;
};

#if SUNDIALS_VERSION_MAJOR >= 7

inline void record_message(int /*line*/, const char* /*function*/, const char* /*file*/, const char* message,
                           SUNErrCode /*code*/, void* log, SUNContext /*context*/) {
  if (message != nullptr) static_cast<MessageLog*>(log)->last_error = message;
}

inline SUNContext create_context(MessageLog& log) {
  SUNContext context = nullptr;
  if (SUNContext_Create(SUN_COMM_NULL, &context) != 0) return nullptr;
  SUNContext_ClearErrHandlers(context);
  SUNContext_PushErrHandler(context, record_message, &log);
  SUNContext_SetLogger(context, nullptr);  // warnings would go to the terminal
  return context;
}

// One handler, that of the context, serves all solvers.
inline void record_cvode_messages(void* /*memory*/, MessageLog& /*log*/) {}
inline void record_ida_messages(void* /*memory*/, MessageLog& /*log*/) {}

#else

inline void record_message(int code, const char* /*module*/, const char* /*function*/, char* message,
                           void* log) {
  constexpr int first_warning = 1;
  if (code < first_warning && message != nullptr) static_cast<MessageLog*>(log)->last_error = message;
}

inline SUNContext create_context(MessageLog& /*log*/) {
  SUNContext context = nullptr;
  return SUNContext_Create(nullptr, &context) == 0 ? context : nullptr;
}

inline void record_cvode_messages(void* memory, MessageLog& log) {
  CVodeSetErrHandlerFn(memory, record_message, &log);
}
inline void record_ida_messages(void* memory, MessageLog& log) {
  IDASetErrHandlerFn(memory, record_message, &log);
}

#endif

/// The functions that CVODE and IDA have in common.
struct Solver {
  const char* name;
  void (*free)(void**);
  int (*set_user_data)(void*, void*);
  int (*set_weights)(void*, int (*)(N_Vector, N_Vector, void*));
  int (*set_max_step)(void*, sunrealtype);
  int (*set_init_step)(void*, sunrealtype);
  int (*set_stop_time)(void*, sunrealtype);
  int (*dense_output)(void*, sunrealtype, int, N_Vector);
  int (*current_step)(void*, sunrealtype*);
  int (*steps)(void*, long*);
  int (*error_test_failures)(void*, long*);
  int (*newton_iterations)(void*, long*);
  int (*local_errors)(void*, N_Vector);
  int (*weights)(void*, N_Vector);
};

#define SEACRANE_SOLVER(name, f)                                                                       \
  Solver {                                                                                             \
    name, f(Free), f(SetUserData), f(WFtolerances), f(SetMaxStep), f(SetInitStep), f(SetStopTime),     \
        f(GetDky), f(GetCurrentStep), f(GetNumSteps), f(GetNumErrTestFails), f(GetNumNonlinSolvIters), \
        f(GetEstLocalErrors), f(GetErrWeights)                                                         \
  }
#define SEACRANE_CVODE(function) CVode##function
#define SEACRANE_IDA(function) IDA##function
inline constexpr Solver cvode = SEACRANE_SOLVER("CVODE", SEACRANE_CVODE);
inline constexpr Solver ida = SEACRANE_SOLVER("IDA", SEACRANE_IDA);
#undef SEACRANE_IDA
#undef SEACRANE_CVODE
#undef SEACRANE_SOLVER

}  // namespace seacrane::sundials
