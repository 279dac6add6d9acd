// Halves: two dense outputs for a step that is too long for one.
#pragma once

#include "saltus/solver/detail/step_polynomial.hpp"

namespace saltus {

/// A method whose dense output p has a lower order than its steps, so that the error estimate of a
/// step does not bound it. If stability or a loose tolerance allows long steps, the error of p is
/// ten times the error of the step, or more. Its defect h (p' - f(t, p)) measures it (W. H.
/// Enright, "Analysis of error control strategies for continuous Runge-Kutta methods", SIAM J.
/// Numer. Anal. 26 (1989) 588). The defect is largest at `defect_at`, and the error is
/// `defect_share` of it.
template <class Method>
concept ChecksDense = requires {
  Method::defect_at;
  Method::defect_share;
  Method::last_term_share;
};

/// A step taken again in two halves of its length, each with a dense output. Their error is 2^-8 of
/// the error of one dense output for the whole step. The halves depend on the step alone and do not
/// change it, so monitors and recorded rows change no results.
template <Tableau Method, int N>
struct Halves {
  explicit Halves(Index n) : middle(n), slope(n), shift(n), first(n), second(n) {}

  /// The state at the part s of the whole step. The end of the second half differs from x1 by the
  /// error of the whole step. The term s^7 corrects this as late as a polynomial of this degree
  /// can, because the error of a solution that grows in the step also arises late.
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
  Eigen::VectorXd middle;  // the state between the halves
  Eigen::VectorXd slope;   // f at the end of the whole step, kept
  Eigen::VectorXd shift;   // from the end of the second half to x1
  StepPolynomial<Method, N> first, second;
};

/// Replaces Halves for a method that does not check its dense output.
struct NoHalves {
  explicit NoHalves(Index) {}
};

}  // namespace saltus
