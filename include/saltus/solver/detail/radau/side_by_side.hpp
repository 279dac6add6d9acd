// Two pieces of work in two threads, where that is faster.
#pragma once

#include <functional>
#include <future>
#include <system_error>

#include "saltus/solver/detail/radau/tuning.hpp"

namespace saltus::radau {

/// Whether the systems of a step are factorised in two threads. `time` [ns] is that of a real
/// matrix; each pair of eigenvalues has a complex one.
///
///   one thread is asked for, or there is one core   no
///   all matrices take less than `apart_from`        no
///   otherwise                                       yes
constexpr bool side_by_side(double time, int pairs, unsigned cores, bool one_thread) {
  const double all = time * (1.0 + tuning::complex_cost * pairs);
  return !one_thread && cores > 1 && all >= tuning::apart_from;
}

/// Calls both, the second in a thread of its own if `apart` and if there is one to be had. Both
/// have ended when it returns, or throws what one of them has thrown.
template <class First, class Second>
void call_both(bool apart, const First& first, const Second& second) {
  std::future<void> other;
  if (apart) {
    try {
      other = std::async(std::launch::async, std::cref(second));
    } catch (const std::system_error&) {  // no thread to be had
    }
  }
  first();  // if it throws, the destructor of `other` waits
  if (other.valid())
    other.get();
  else
    second();
}

}  // namespace saltus::radau
