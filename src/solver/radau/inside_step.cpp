// Looks inside a step of the Radau methods: its polynomial, its halves, and its cut at an event.
#include <algorithm>
#include <limits>
#include <utility>

#include "saltus/solver/detail/radau/cut.hpp"
#include "solver.hpp"

namespace saltus::radau {

void RadauSolver::inside_step(double u, double* x) {
  if (!inside_.known) look_inside();
  if (inside_.halved)
    inside_.halves.read(x0_.data(), u / length_, x);
  else
    step_.read(x0_.data(), u / length_, x);
}

double RadauSolver::joint() {
  if (!inside_.known) look_inside();
  return inside_.halved ? t0_ + 0.5 * length_ : -infinite;
}

void RadauSolver::look_inside() {
  inside_.known = true;
  inside_.halved = dense_error() > thresholds::dense_room &&
                   inside_.halves.solve(stages_, t0_, x0_, x1_, length_, step_);
}

bool RadauSolver::cut(double root) {
  const double moved = in_tolerances(x1_ - x0_);
  const double off = dense_error() / std::max(moved, std::numeric_limits<double>::min());
  const double h = cut_length(root, length_, off);
  if (h == 0.0) return false;
  std::swap(step_, last_);
  step_.stages = last_.stages;
  last_.predict(step_.stages, 0.0, h / length_, step_.z);
  if (!stages_.solve_aside(t0_, x0_, h, step_)) {
    std::swap(step_, last_);
    return false;
  }
  t1_ = t0_ + h;
  finish_stages(h);
  return true;
}

}  // namespace saltus::radau
