// The one-step methods, each compiled once and in a file of its own: together in one, the compiler
// inlines less of either.
#pragma once

#include "saltus/solver/dop853.hpp"
#include "saltus/solver/dopri5.hpp"
#include "saltus/solver/runge_kutta.hpp"

namespace saltus {

extern template class RungeKutta<Dopri5>;
extern template class RungeKutta<Dop853>;

}  // namespace saltus
