// Radau IIA with any number of stages, in binary128 (34 digits): for references, not for speed.
// E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, section IV.5 and IV.8: the
// nodes are the zeros of P_s(2 x - 1) - P_{s-1}(2 x - 1), the order is 2 s - 1. Simplified Newton
// with an LU in long double (newton.hpp), iterated until nothing moves in 31 digits. The step is
// chosen by the leading coefficient of the collocation polynomial, which is what a polynomial of
// one degree less would miss; the ends of steps, of order 2 s - 1, are far better than that.
#pragma once

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "newton.hpp"

class Radau {
 public:
  Radau(const Problem& problem, int stages, double tolerance, bool tangents);

  void advance_to(Quad end);
  const Vector& state() const { return y_; }
  const std::vector<std::vector<Quad>>& roots() const { return roots_; }
  std::size_t steps() const { return states_.size() - 1; }
  /// The largest |W^-1 Phi W_s| in the maximum norm, W = ratio + |y|, over the propagators Phi from
  /// each step to each of the steps `marks`. Needs tangents.
  double growth(double ratio, const std::vector<std::size_t>& marks) const;

 private:
  using Stages = std::vector<Vector>;
  Stages predict(Quad h) const;
  bool solve(Quad h, Stages& stages);
  Matrix propagator(Quad h, const Stages& stages) const;
  Quad error(const Stages& stages) const;
  void locate(std::size_t guard, Quad h);
  void accept(Quad h, const Stages& stages);

  const Problem& problem_;
  Tableau tableau_;
  Differences differences_;
  Newton newton_;
  double tolerance_;
  bool tangents_;
  Quad t_ = 0, h_, last_h_ = 0;
  Vector y_, last_y_;
  Stages last_;
  std::vector<Vector> states_;
  std::vector<Matrix> propagators_;
  std::vector<std::vector<Quad>> roots_;
};
