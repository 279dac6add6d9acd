// y = N (u - x), dx/dt = y, elementwise: the derivative of u behind a filter, s N / (s + N).
// in, out: the shape of initial_state. Parameter "filter_coefficient" N [1/s]. x follows u with the
// lag 1/N. A step of u by 1 makes a peak of N. There is no derivative without a filter: it would be
// undefined at each event, and an algebraic loop with a derivative is no ODE.
#pragma once

#include "saltus/library/detail/arguments.hpp"

namespace saltus {

struct DerivativeOptions {
  Value filter_coefficient = 100.0;  ///< [1/s] > 0
  Value initial_state = 0.0;         ///< x at the start; with the first value of u, y starts at 0
};

class Derivative final : public LeafSystem {
 public:
  using Options = DerivativeOptions;

  explicit Derivative(std::string name, const Options& options = {});
};

}  // namespace saltus
