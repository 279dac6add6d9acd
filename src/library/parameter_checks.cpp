// The values of parameters that blocks refuse.
#include "saltus/library/detail/parameter_checks.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "saltus/library/detail/elementwise.hpp"

namespace saltus::detail {

ParameterCheck positive(ParameterIndex k, std::string what, std::string unit, std::string why) {
  return [=](const std::string& block, const ParameterValues& values) {
    for (const double each : values.vector(k))
      insist(each > 0.0 && std::isfinite(each), block, what, " = ", each, unit,
             "; expected a finite number > 0", why);
  };
}

ParameterCheck not_negative(ParameterIndex k, std::string what, std::string unit) {
  return [=](const std::string& block, const ParameterValues& values) {
    for (const double each : values.vector(k))
      insist(each >= 0.0, block, what, " = ", each, unit, "; expected a number >= 0");
  };
}

ParameterCheck ordered(ParameterIndex lower, ParameterIndex upper, std::string unit,
                       std::string limit) {
  return [=](const std::string& block, const ParameterValues& values) {
    for (Index i = 0; i < std::max(lower.size, upper.size); ++i) {
      const double low = entry(values.vector(lower), i), high = entry(values.vector(upper), i);
      insist(low <= high, block, "lower_", limit, " ", low, unit, " is above upper_", limit, " ",
             high, unit, "; expected lower_", limit, " <= upper_", limit);
    }
  };
}

ParameterCheck apart(ParameterIndex lower, ParameterIndex upper) {
  return [=](const std::string& block, const ParameterValues& values) {
    insist(values[lower] < values[upper], block, "lower_limit ", values[lower],
           " is not below upper_limit ", values[upper], "; expected lower_limit < upper_limit");
  };
}

}  // namespace saltus::detail
