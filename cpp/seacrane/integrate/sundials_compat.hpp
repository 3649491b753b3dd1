#pragma once

// The differences between the SUNDIALS releases 6.x and 7.x, and nothing else. Compiled and tested with
// 6.4; the branches for 7.x follow its documentation and headers and have not been compiled.

#include <arkode/arkode_erkstep.h>
#include <cvode/cvode.h>
#include <cvode/cvode_ls.h>
#include <cvode/cvode_proj.h>
#include <ida/ida.h>
#include <ida/ida_ls.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_config.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_types.h>
#include <sunlinsol/sunlinsol_dense.h>
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
inline void record_arkode_messages(void* /*memory*/, MessageLog& /*log*/) {}

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
inline void record_arkode_messages(void* memory, MessageLog& log) {
  ERKStepSetErrHandlerFn(memory, record_message, &log);
}

#endif

// From 7.1 on ARKODE's steppers share one set of functions and the ERKStep names are deprecated.
#if SUNDIALS_VERSION_MAJOR > 7 || (SUNDIALS_VERSION_MAJOR == 7 && SUNDIALS_VERSION_MINOR >= 1)
#define SEACRANE_ERK(function) ARKode##function
#else
#define SEACRANE_ERK(function) ERKStep##function
#endif

}  // namespace seacrane::sundials
