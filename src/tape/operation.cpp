#include "saltus/tape/operation.hpp"
#include "saltus/base/list.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "saltus/base/error.hpp"

namespace saltus::tape {

namespace {

constexpr std::array<std::string_view, operation_count> names = {"constant",
                                                                 "time",
                                                                 "continuous_state",
                                                                 "discrete_state",
                                                                 "mode",
                                                                 "entry",
                                                                 "parameter",
                                                                 "input",
                                                                 "neg",
                                                                 "abs",
                                                                 "sqrt",
                                                                 "cbrt",
                                                                 "exp",
                                                                 "exp2",
                                                                 "expm1",
                                                                 "log",
                                                                 "log2",
                                                                 "log10",
                                                                 "log1p",
                                                                 "sin",
                                                                 "cos",
                                                                 "tan",
                                                                 "asin",
                                                                 "acos",
                                                                 "atan",
                                                                 "sinh",
                                                                 "cosh",
                                                                 "tanh",
                                                                 "asinh",
                                                                 "acosh",
                                                                 "atanh",
                                                                 "floor",
                                                                 "ceil",
                                                                 "trunc",
                                                                 "rint",
                                                                 "sign",
                                                                 "logical_not",
                                                                 "add",
                                                                 "sub",
                                                                 "mul",
                                                                 "div",
                                                                 "pow",
                                                                 "atan2",
                                                                 "hypot",
                                                                 "copysign",
                                                                 "mod",
                                                                 "fmod",
                                                                 "floor_divide",
                                                                 "minimum",
                                                                 "maximum",
                                                                 "lt",
                                                                 "le",
                                                                 "gt",
                                                                 "ge",
                                                                 "eq",
                                                                 "ne",
                                                                 "logical_and",
                                                                 "logical_or",
                                                                 "select"};
static_assert(!names.back().empty());  // one for each operation

}  // namespace

std::string_view name(Op op) { return nth(names, op); }

std::optional<Op> operation(std::string_view name) {
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) return {};
  return static_cast<Op>(found - names.begin());
}

Op known_operation(std::string_view name) {
  if (const auto op = operation(name)) return *op;
  const auto first = names.begin() + static_cast<int>(Op::neg);
  const std::vector<std::string> known(first, names.end());
  throw ModelError(text("there is no operation '", name, "'", known_names(name, known)));
}

}  // namespace saltus::tape
