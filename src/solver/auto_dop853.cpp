// "auto" with dop853, compiled.
#include "saltus/solver/auto_solver.hpp"

template class saltus::AutoSolver<saltus::Dop853>;
