// The headers that nearly every test includes, compiled once.
#pragma once

#include "saltus/library/library.hpp"
#include "saltus/simulation/simulate.hpp"
#include "support/balls.hpp"
#include "support/catch.hpp"
#include "support/leaves.hpp"
#include "support/run.hpp"
