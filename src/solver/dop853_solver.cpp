// DOP853, compiled.
#include "saltus/solver/one_step.hpp"

template class saltus::RungeKutta<saltus::Dop853>;
