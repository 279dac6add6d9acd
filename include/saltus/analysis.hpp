// Everything that is computed from many runs or linearisations of one system. It is not part of
// saltus/saltus.hpp.
#pragma once

#include "saltus/analysis/equilibria.hpp"
#include "saltus/analysis/fit.hpp"
#include "saltus/analysis/lyapunov.hpp"
#include "saltus/analysis/period_map.hpp"
#include "saltus/analysis/periodic_orbit.hpp"
#include "saltus/analysis/trim.hpp"
