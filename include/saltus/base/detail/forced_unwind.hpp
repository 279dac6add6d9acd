// The forced end of a thread has to pass through every `catch (...)`.
#pragma once

#include <cxxabi.h>

namespace saltus::detail {

/// Lets the forced unwinding of pthread_exit, or of a cancelled thread, continue. Each `catch
/// (...)` that does not end with `throw;` calls this function first, because the C library ends the
/// program if the unwinding stops there.
inline void pass_end_of_thread() {
#ifdef __GLIBCXX__
  try {
    throw;
  } catch (const abi::__forced_unwind&) {
    throw;
  } catch (...) {  // an ordinary exception: the calling handler deals with it
  }
#endif
}

}  // namespace saltus::detail
