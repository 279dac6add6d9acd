// Halves: the dense output of a step that is too long for one.
#pragma once

#include "saltus/solver/detail/step_polynomial.hpp"

namespace saltus {

/// A method whose dense output p is of lower order than its steps, so that no error estimate of a
/// step holds it: where stability or a loose tolerance lets steps be long, it misses by ten times
/// what the step does, and more. How much shows in its defect h (p' - f(t, p)) (W. H. Enright,
/// "Analysis of error control strategies for continuous Runge-Kutta methods", SIAM J. Numer. Anal.
/// 26 (1989) 588): at `defect_at` it is largest, and `defect_share` of it is the error.
template <class Method>
concept ChecksDense = requires {
  Method::defect_at;
  Method::defect_share;
  Method::last_term_share;
};

/// A step taken again in two halves of its length, each with a dense output: those miss by 2^-8 of
/// what one of the whole step does. They depend on the step alone, not on who looks into it, and
/// change nothing of it: so monitors and recorded rows change nothing either.
template <Tableau Method, int N>
struct Halves {
  explicit Halves(Index n) : middle(n), slope(n), shift(n), first(n), second(n) {}

  /// The state at the part s of the whole step. The second half ends beside x1 by what the whole
  /// step is off: that is made up for as late as a polynomial of this degree can, since where a
  /// solution grows in the step its error is made late too.
  [[gnu::noinline]] void read(const double* x0, double s, double* x) const {
    if (s < 0.5)
      first.read(x0, 2.0 * s, x);
    else
      second.read(middle.data(), 2.0 * s - 1.0, x);
    const double cube = s * s * s;
    VectorRef(x, shift.size()) += s * cube * cube * shift;
  }
  bool finite() const { return shift.allFinite() && first.finite() && second.finite(); }

  bool used = false;
  Eigen::VectorXd middle;  // the state between them
  Eigen::VectorXd slope;   // f at the end of the whole step, kept
  Eigen::VectorXd shift;   // from the end of the second half to x1
  StepPolynomial<Method, N> first, second;
};

/// For a method without.
struct NoHalves {
  explicit NoHalves(Index) {}
};

}  // namespace saltus
