// DOPRI5, compiled.
#include "saltus/solver/one_step.hpp"

template class saltus::RungeKutta<saltus::Dopri5>;
