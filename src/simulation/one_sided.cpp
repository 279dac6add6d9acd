// OneSided: what an instant changes.
#include "saltus/simulation/detail/one_sided.hpp"

#include <cmath>

namespace saltus {

namespace {

/// Two derivatives are the same if they differ by no more than this part of their terms. Those of
/// called functions are differences with errors of 1e-10 (see TangentProbe), which the terms amplify.
constexpr double same_derivative = 1e-6;

}  // namespace

void OneSided::judge(double t, const Machine& machine, const TangentColumns& moving,
                     const TangentColumns& fixed, const std::string& event) {
  t_ = t, event_ = event;
  of_x_.setConstant(x_.size(), fixed.size(), false);
  of_z_.setConstant(z_.size(), fixed.size(), false);
  for (Index k = 0; k < fixed.size(); ++k) {
    if (!(std::abs(moving.t[k]) > 0.0)) continue;  // it does not move, or has no derivative
    for (Index i = 0; i < x_.size(); ++i) {
      const double now = fixed.x(i, k), was = before_.x(i, k), all = moving.x(i, k);
      const double terms = std::abs(all) + std::abs(all - now) + std::abs(was);
      of_x_(i, k) = machine.x[i] != x_[i] || std::abs(now - was) > same_derivative * terms;
    }
    for (Index i = 0; i < z_.size(); ++i) {
      const double now = fixed.z(i, k), was = before_.z(i, k);
      of_z_(i, k) = machine.z[i] != z_[i] || std::abs(now - was) > same_derivative * std::abs(was);
    }
  }
}

}  // namespace saltus
