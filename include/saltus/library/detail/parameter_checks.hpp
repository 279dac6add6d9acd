// The values of parameters that blocks refuse, in their constructors and in contexts.
#pragma once

#include <string>

#include "saltus/library/detail/arguments.hpp"

namespace saltus::detail {

/// Each entry of a parameter is a finite number > 0. A message says "what = 0 unit; expected a
/// finite number > 0", and goes on with `why`.
ParameterCheck positive(ParameterIndex k, std::string what, std::string unit = {},
                        std::string why = {});

/// Each entry of a parameter is a number >= 0.
ParameterCheck not_negative(ParameterIndex k, std::string what, std::string unit = {});

/// Each entry of the lower limit is at most that of the upper one. `limit` ends the names of both.
ParameterCheck ordered(ParameterIndex lower, ParameterIndex upper, std::string unit = {},
                       std::string limit = "limit");

/// The lower limit is below the upper one.
ParameterCheck apart(ParameterIndex lower, ParameterIndex upper);

}  // namespace saltus::detail
