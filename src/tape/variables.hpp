// The variables and constants of a tape: where they are read.
#pragma once

#include "program.hpp"

namespace saltus::tape::detail {

/// The place of a variable or a constant; an operation has none here. The program notes the arrays
/// that it reads and how many entries it needs.
Place place_of_variable(Program& program, const Expression& e);

}  // namespace saltus::tape::detail
