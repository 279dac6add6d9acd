// The variables and constants of a tape: where they are read.
#pragma once

#include "program.hpp"

namespace saltus::tape::detail {

/// The place of a variable or a constant. The program notes what it reads and how many entries it
/// needs. Not for operations.
Place place_of_variable(Program& program, const Expression& e);

}  // namespace saltus::tape::detail
