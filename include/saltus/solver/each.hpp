// A loop over the states that costs nothing where there are few of them.
#pragma once

#include "saltus/base/ids.hpp"

namespace saltus::detail {

/// f(0), ..., f(n - 1) for entries that do not depend on each other. Up to four are written out: compilers turn the
/// loop into wide vector code whose preparations cost more than two states' arithmetic.
template <class F>
[[gnu::flatten]] inline void each(Index n, F f) {
  if (n == 2) {
    for (Index i = 0; i < 2; ++i) f(i);
  } else if (n == 3) {
    for (Index i = 0; i < 3; ++i) f(i);
  } else if (n == 4) {
    for (Index i = 0; i < 4; ++i) f(i);
  } else {
    for (Index i = 0; i < n; ++i) f(i);
  }
}

}  // namespace saltus::detail
