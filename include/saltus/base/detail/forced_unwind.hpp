// The end of a thread, which passes through handlers of every exception.
#pragma once

#include <cxxabi.h>

namespace saltus::detail {

/// Passes the forced unwinding of pthread_exit and of a cancelled thread on. Called first in a
/// handler of every exception that does not end with `throw;`: the C library ends the program if
/// the unwinding stops there.
inline void pass_end_of_thread() {
#ifdef __GLIBCXX__
  try {
    throw;
  } catch (const abi::__forced_unwind&) {
    throw;
  } catch (...) {  // an exception: the handler that called takes it
  }
#endif
}

}  // namespace saltus::detail
