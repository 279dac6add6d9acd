// "auto" with dopri5, compiled.
#include "saltus/solver/auto_solver.hpp"

template class saltus::AutoSolver<saltus::Dopri5>;
