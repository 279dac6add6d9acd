// Functions that a user compiled: an address that is called without the interpreter.
#pragma once

namespace saltus::python {

/// `f(t, x, u, p, out, user_data)`; python/saltus/compiled.py documents the arguments. 0 means
/// success.
using CompiledPointer = int (*)(double t, const double* x, const double* u, const double* p,
                                double* out, void* user_data);

}  // namespace saltus::python
