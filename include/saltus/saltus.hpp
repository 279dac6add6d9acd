// All public headers.
#pragma once

#include "saltus/library/library.hpp"
#include "saltus/simulation/simulate.hpp"
