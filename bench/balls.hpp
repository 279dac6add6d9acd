// n balls that fall on one floor, e = 0.9, as one leaf with a vector guard.
#pragma once

#include <cmath>
#include <saltus/saltus.hpp>
#include <string>
#include <utility>

namespace bench {

/// Heights first, then speeds; one call computes all guards.
class Balls final : public saltus::LeafSystem {
 public:
  explicit Balls(const Eigen::VectorXd& heights, std::string name = "balls")
      : LeafSystem(std::move(name)), n_(heights.size()) {
    Eigen::VectorXd start = Eigen::VectorXd::Zero(2 * n_);
    start.head(n_) = heights;
    declare_continuous_state({.initial = start, .ode = [n = n_](const At& at, VectorRef xdot) {
                                xdot.head(n) = at.x.tail(n);
                                xdot.tail(n).setConstant(-9.81);
                              }});
    declare_zero_crossing({.name = "bounce",
                           .guard = [n = n_](const At& at, VectorRef out) { out = at.x.head(n); },
                           .reset_map = &Balls::bounce,
                           .direction = saltus::Direction::positive_then_non_positive,
                           .size = n_});
  }

 private:
  void bounce(const At& at, Next& next) const {
    Eigen::VectorXd x = at.x;
    x[at.entry] = std::abs(x[at.entry]);
    x[n_ + at.entry] *= -0.9;
    next.set_continuous_state(x);
  }
  saltus::Index n_;
};

}  // namespace bench
