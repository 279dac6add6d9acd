// The whole library. Ready scenes and reports stand apart: saltus/models/models.hpp,
// saltus/report/work_precision.hpp.
#pragma once

#include "saltus/library/library.hpp"
#include "saltus/model/diagram_builder.hpp"
#include "saltus/simulation/check_derivatives.hpp"
#include "saltus/simulation/evaluate.hpp"
#include "saltus/simulation/linearize.hpp"
#include "saltus/simulation/outcomes.hpp"
#include "saltus/simulation/simulate.hpp"
#include "saltus/tape/jacobian.hpp"
