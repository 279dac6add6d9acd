// y follows u through a play: it rests until u reaches one end of the play, and then moves with it
// until u turns. y = u - width / 2 while u drives it upward, u + width / 2 downward.
// in: u; in_rate: du/dt; out: y; out_rate: dy/dt, 0 or du/dt. All scalar; u is continuous, such as
// the position of a shaft whose speed is in_rate. Parameter "width" > 0, the whole play. The
// contact and the turn are located as events. If u starts outside of the play around
// initial_output, the run starts in contact, and y moves. A run ends with an error where u comes back
// to the place of its contact and in_rate has not changed its sign: then it is not the rate of u.
#pragma once

#include "saltus/library/detail/arguments.hpp"

namespace saltus {

struct BacklashOptions {
  double initial_output = 0.0;  ///< y at the start
};

class Backlash final : public LeafSystem {
 public:
  using Options = BacklashOptions;

  Backlash(std::string name, double width, const Options& options = {});

 private:
  void declare_contact(const char* event, double side, ParameterIndex width);
  void declare_turn(ParameterIndex width);
  void declare_return(ParameterIndex width);
  void declare_outputs(ParameterIndex width);
};

}  // namespace saltus
