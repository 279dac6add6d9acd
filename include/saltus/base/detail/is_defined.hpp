// is_defined: whether a function has a value at a point that the solution need not reach.
#pragma once

#include "saltus/base/detail/forced_unwind.hpp"
#include "saltus/base/error.hpp"

namespace saltus::detail {

/// Makes a call, and returns whether it came to its end. An exception means that the function has no value
/// there, and is dropped. An Interruption, and the end of the thread, pass.
template <class Call>
bool is_defined(const Call& call) {
  try {
    call();
    return true;
  } catch (const Interruption&) {
    throw;
  } catch (...) {
    pass_end_of_thread();
    return false;
  }
}

}  // namespace saltus::detail
