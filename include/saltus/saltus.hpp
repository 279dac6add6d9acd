// All public headers.
#pragma once

#include "saltus/library/library.hpp"
#include "saltus/model/diagram_builder.hpp"
#include "saltus/simulation/simulate.hpp"
