// Convergence of a one-step method on a problem with a known answer.
#pragma once

#include "saltus/solver/detail/runge_kutta.hpp"
#include "support/leaves.hpp"

namespace support {

/// x' = x (1 - x), x(0) = 0.1: the logistic equation.
inline Leaf logistic() {
  return Leaf("logistic", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.1}), .ode = [](const At& at) { return at.x[0] * (1.0 - at.x[0]); }});
    l.declare_continuous_state_output("x");
  });
}
inline double logistic_at(double t) { return 1.0 / (1.0 + 9.0 * std::exp(-t)); }

/// Largest error of the logistic equation at the ends of n equal steps to t = 4, and at eight
/// points inside each.
struct StepErrors {
  double ends = 0.0, inside = 0.0;
};

template <class Method>
StepErrors step_errors(int n) {
  const Leaf leaf = logistic();
  saltus::Machine machine(saltus::compile(leaf));
  machine.load(leaf.create_context());
  saltus::GuardSet guards;
  const double h = 4.0 / n;
  // A tolerance that every step meets, so that the steps are h.
  saltus::RungeKutta<Method> solver(machine, guards, {.rtol = 1e6, .atol = 1e6, .max_step = h});
  solver.restart(0.0, machine.x, {.first = true});
  StepErrors worst;
  for (int i = 1; i <= n; ++i) {
    const double end = h * i;
    while (solver.time() < end) solver.advance(end);
    worst.ends = std::max(worst.ends, std::abs(solver.state()[0] - logistic_at(end)));
    for (int k = 1; i > 1 && k < 9; ++k) {  // the first stretch has shorter steps
      double x = 0.0;
      const double t = end - h + h * k / 9.0;
      solver.interpolate(t, &x);
      worst.inside = std::max(worst.inside, std::abs(x - logistic_at(t)));
    }
  }
  CHECK(solver.statistics().steps <= n + 6);
  return worst;
}

/// The observed order when steps are halved.
inline double order(double coarse, double fine) { return std::log2(coarse / fine); }

/// Largest deviation of a tableau's row sums from c.
template <class Method>
double worst_row_sum() {
  double worst = 0.0;
  for (std::size_t i = 0; i < Method::rows; ++i) {
    double sum = 0.0;
    for (const double a : Method::a[i]) sum += a;
    worst = std::max(worst, std::abs(sum - Method::c[i]));
  }
  return worst;
}

/// sum_j row[j] c[j]^k
template <class Method, class Row>
double moment(const Row& row, int k) {
  double sum = 0.0;
  for (std::size_t j = 0; j < row.size(); ++j)
    sum += row[j] * (k == 0 ? 1.0 : std::pow(Method::c[j], k));
  return sum;
}

}  // namespace support
