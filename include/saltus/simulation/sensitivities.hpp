// Sensitivities: the derivatives of a run with respect to parameters and start values.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "saltus/simulation/detail/tangent_trajectory.hpp"

namespace saltus {

/// An instant from which on a derivative does not exist, or at which it does not: a run that ends
/// there, or a single row there, has one-sided derivatives only.
struct SensitivityGap {
  double time = 0.0;      ///< [s]
  std::string event;      ///< "ball.bounce"
  std::string reason;     ///< why there is none
  std::string parameter;  ///< with respect to which
};

/// The derivatives of a run with the option `sensitivity`. Each array has the parameter as its last
/// axis, so entry k of a group of `parameters.size()` numbers is with respect to parameter k.
///
/// The derivatives of rows and of the final state are those at a fixed time. That of an event is
/// the derivative of its time. After a gap, or at it, they are NaN.
struct Sensitivities {
  std::vector<std::string> parameters;  ///< the names of the single entries
  std::vector<std::vector<double>>
      signals;                      ///< of each recorded signal: rows x entries x parameters
  std::vector<double> event_times;  ///< events x parameters
  std::vector<double> predicted;    ///< events x parameters: of Event::predicted, else NaN
  std::vector<double> continuous_state, discrete_state;  ///< at the end: entries x parameters
  std::vector<SensitivityGap> gaps;                      ///< in order of time
  TangentTrajectory trajectory;  ///< with the option dense_output; otherwise empty

  bool empty() const noexcept { return parameters.empty(); }
  std::size_t size() const noexcept { return parameters.size(); }
};

}  // namespace saltus
