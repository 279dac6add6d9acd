// v = kp u + i + kd n (u - f), di/dt = ki u, df/dt = n (u - f); y = v, or v between the limits.
// in: the error, scalar. out: scalar. Parameters "kp", "ki" [1/s], "kd" [s], "n" [1/s], and the
// limits, if given: "lower_limit", "upper_limit", "band". The derivative has a filter of the
// coefficient n, always: see Derivative.
// With a limit the integral i is clamped: it does not change from the time at which v is beyond a
// limit and the error pushes outward, until the error turns or v is inside again by `band`. Both
// times are located. The band prevents chattering: without it v would slide along the limit while
// the error falls, neither beyond it nor inside.
#pragma once

#include <optional>

#include "saltus/library/detail/arguments.hpp"

namespace saltus {

struct PIDOptions {
  double kp = 1.0;
  double ki = 0.0;             ///< [1/s]
  double kd = 0.0;             ///< [s]
  double n = 100.0;            ///< [1/s] > 0, of the filter of the derivative
  double initial_state = 0.0;  ///< of the integral i, in the unit of y
  std::optional<double> lower_limit = {};
  std::optional<double> upper_limit = {};
  /// > 0, in the unit of y. If not given: 1e-3 of the distance of the limits, or of the limit.
  std::optional<double> band = {};
};

class PID final : public LeafSystem {
 public:
  using Options = PIDOptions;

  explicit PID(std::string name, const Options& options = {});

 private:
  struct Gains {
    ParameterIndex kp, ki, kd, n;
  };
  struct Limit {
    Index entry = 0;       ///< in z: 1 while the integral is clamped at this limit
    double outward = 0.0;  ///< 1 for the upper limit, -1 for the lower
    ParameterIndex value = {};
    RelationIndex beyond = {};
  };

  void declare_limits(const Options& options);
  void declare_limit(const char* parameter, double value, double outward, ParameterIndex band);
  void declare_state(double initial);
  void declare_output();

  Gains k_ = {};
  std::vector<Limit> limits_;
};

}  // namespace saltus
