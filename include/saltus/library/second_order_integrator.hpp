// d2x/dt2 = u: position x and velocity dx, elementwise; at a limit of x the body stops, or rebounds.
// in: acceleration. x, dx: outputs, views of the state. All have the shape of initial_position.
// Parameters "lower_limit", "upper_limit", if given, and then "restitution". Where x reaches a limit
// outward, x becomes the limit and dx becomes -restitution dx. With restitution 0, and where
// rebounds accumulate, the entry rests at the limit until u points inward. A run does not begin beyond
// a limit of x or of dx: that is a BlockParameterError.
// Parameters "lower_velocity_limit", "upper_velocity_limit", if given: an entry of dx that is at a
// limit is constant while u points outward, and dx after a rebound is within the limits. Both ends
// of that are located.
#pragma once

#include <optional>

#include "saltus/library/detail/arguments.hpp"

namespace saltus {

struct SecondOrderIntegratorOptions {
  Value initial_position = 0.0;
  Value initial_velocity = 0.0;
  std::optional<Value> lower_limit = {};  ///< of x
  std::optional<Value> upper_limit = {};
  double restitution = 0.0;  ///< 0 to 1: speed after a limit over speed before it
  std::optional<Value> lower_velocity_limit = {};  ///< of dx
  std::optional<Value> upper_velocity_limit = {};
};

class SecondOrderIntegrator final : public LeafSystem {
 public:
  using Options = SecondOrderIntegratorOptions;

  explicit SecondOrderIntegrator(std::string name, const Options& options = {});

 private:
  void require_sound(const Options& options) const;
  void require_inside(const Options& options) const;
  void declare_motion(const Options& options);
  RelationIndex declare_velocity_limit(const char* parameter, const char* relation,
                                       const Value& limit, double outward);
  void declare_limits(const Options& options);
  ParameterIndex declare_limit(const char* parameter, const Value& limit, double outward,
                               ParameterIndex restitution);

  Index n_ = 1;                                      // width
  std::optional<ParameterIndex> slowest_, fastest_;  // limits of dx
};

}  // namespace saltus
