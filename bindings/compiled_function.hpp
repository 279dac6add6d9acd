// Functions that a user compiled: an address, called without the interpreter.
#pragma once

namespace saltus::python {

/// `f(t, x, u, p, out, user_data)`; python/saltus/compiled.py says what these hold. 0 is success.
using CompiledPointer = int (*)(double t, const double* x, const double* u, const double* p,
                                double* out, void* user_data);

}  // namespace saltus::python
