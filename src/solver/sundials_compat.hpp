// The differences between SUNDIALS 6.2 to 6.x and 7.x, and owners for its C handles.
#pragma once

#include <memory>
#include <type_traits>

#include <sundials/sundials_config.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_types.h>
#if defined(SALTUS_SUNDIALS_CVODES)
#include <cvodes/cvodes.h>
#include <cvodes/cvodes_ls.h>
#else
#include <cvode/cvode.h>
#include <cvode/cvode_ls.h>
#endif
#include <nvector/nvector_serial.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#if !defined(SUNDIALS_VERSION_MAJOR) || SUNDIALS_VERSION_MAJOR * 100 + SUNDIALS_VERSION_MINOR < 602
#error "Saltus needs SUNDIALS 6.2 or newer"
#endif
static_assert(std::is_same_v<sunrealtype, double>,
              "Saltus needs a SUNDIALS built for double precision");

namespace saltus::sun {

struct FreeContext {
  void operator()(SUNContext context) const { SUNContext_Free(&context); }
};
struct FreeVector {
  void operator()(N_Vector vector) const { N_VDestroy(vector); }
};
struct FreeMatrix {
  void operator()(SUNMatrix matrix) const { SUNMatDestroy(matrix); }
};
struct FreeLinear {
  void operator()(SUNLinearSolver solver) const { SUNLinSolFree(solver); }
};
struct FreeNonlinear {
  void operator()(SUNNonlinearSolver solver) const { SUNNonlinSolFree(solver); }
};
struct FreeCvode {
  void operator()(void* memory) const { CVodeFree(&memory); }
};

template <class Handle, class Free>
using Owner = std::unique_ptr<std::remove_pointer_t<Handle>, Free>;
using Context = Owner<SUNContext, FreeContext>;
using Vector = Owner<N_Vector, FreeVector>;
using Matrix = Owner<SUNMatrix, FreeMatrix>;
using Linear = Owner<SUNLinearSolver, FreeLinear>;
using Nonlinear = Owner<SUNNonlinearSolver, FreeNonlinear>;
using Cvode = Owner<void*, FreeCvode>;

/// A context that prints nothing. Each solver has its own, because threads may not share one.
inline Context make_context() {
  SUNContext context = nullptr;
#if SUNDIALS_VERSION_MAJOR >= 7
  if (SUNContext_Create(SUN_COMM_NULL, &context) != 0) return nullptr;
  SUNContext_ClearErrHandlers(context);  // the default handler prints
#else
  if (SUNContext_Create(nullptr, &context) != 0) return nullptr;
#endif
  return Context(context);
}

/// Receives the text of an error: `sink(message, user)`.
using ErrorSink = void (*)(const char* message, void* user);

struct ErrorHook {
  ErrorSink sink = nullptr;
  void* user = nullptr;
};

#if SUNDIALS_VERSION_MAJOR >= 7
inline void on_error(int, const char*, const char*, const char* message, SUNErrCode, void* data,
                     SUNContext) {
  const auto* hook = static_cast<ErrorHook*>(data);
  hook->sink(message == nullptr ? "" : message, hook->user);
}
inline void hook_errors(SUNContext context, void*, ErrorHook* hook) {
  SUNContext_PushErrHandler(context, on_error, hook);
}
#else
inline void on_error(int, const char*, const char*, char* message, void* data) {
  const auto* hook = static_cast<ErrorHook*>(data);
  hook->sink(message == nullptr ? "" : message, hook->user);
}
inline void hook_errors(SUNContext, void* cvode, ErrorHook* hook) {
  CVodeSetErrHandlerFn(cvode, on_error, hook);
}
#endif

}  // namespace saltus::sun
