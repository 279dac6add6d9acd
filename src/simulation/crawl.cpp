#include "saltus/simulation/detail/crawl.hpp"

#include <cmath>

#include "saltus/simulation/detail/thresholds.hpp"
#include "saltus/solver/detail/guard.hpp"

namespace saltus {

void Crawl::begin(double t) {
  window_ = thresholds::crawl_window;
  steps_ = 0, since_ = t, looking_ = false;
  // Here, because no step may allocate.
  for (auto* each : {&low_, &high_, &middle_, &f_from_, &f_to_, &f_})
    each->resize(machine_->plan().nx);
}

/// A window is full: the looks ahead start if it took little time.
void Crawl::start(double t, double length_of_run) {
  const double took = t - since_;
  if (took < thresholds::crawl_share * length_of_run) {
    looking_ = true, compared_ = reversals_ = 0;
    ahead_ = thresholds::crawl_ahead * took / static_cast<double>(steps_);
  } else {
    steps_ = 0, since_ = t;
  }
}

/// The derivative at a state that the solution need not reach: false if it is not defined there.
bool Crawl::found_at(double t, const Eigen::VectorXd& x, Eigen::VectorXd& f) {
  try {
    machine_->derivative(t, x.data(), f.data());
    return true;
  } catch (const Interruption&) {
    throw;
  } catch (...) {
    return false;
  }
}

bool Crawl::found(double t, const Eigen::VectorXd& x) {
  machine_->derivative(t, x.data(), f_from_.data());
  high_ = x + ahead_ * f_from_;
  ++compared_;
  const Index state = found_at(t, high_, f_to_) ? reverses() : -1;
  if (state >= 0) ++reversals_;
  if (state >= 0 && reversals_ >= thresholds::crawl_reversals && jumps(t, x, state)) {
    jump_.steps = steps_ + compared_, jump_.took = t - since_;
    return true;
  }
  if (compared_ >= thresholds::crawl_compared) {
    window_ *= 2;
    steps_ = 0, since_ = t, looking_ = false;
  }
  return false;
}

Index Crawl::reverses() const {
  Index most = -1;
  double size = 0.0;
  for (Index i = 0; i < f_to_.size(); ++i) {
    const double change = std::abs(f_to_[i] - f_from_[i]);
    if (sign_of(f_from_[i]) * sign_of(f_to_[i]) < 0 && change > size) most = i, size = change;
  }
  return most;
}

/// Bisects the way from x to the state ahead, at time t, until its ends are neighbours.
bool Crawl::jumps(double t, const Eigen::VectorXd& x, Index state) {
  const double whole = std::abs(f_to_[state] - f_from_[state]);
  low_ = x;
  double below = f_from_[state], above = f_to_[state];
  for (int halving = 0; halving < thresholds::crawl_halvings; ++halving) {
    middle_ = low_ + 0.5 * (high_ - low_);
    if (middle_ == low_ || middle_ == high_) break;
    if (!found_at(t, middle_, f_)) return false;
    const bool lower = sign_of(f_[state]) == sign_of(below);
    (lower ? low_ : high_) = middle_;
    (lower ? below : above) = f_[state];
    if (std::abs(above - below) < 0.5 * whole) return false;  // it changes gradually
  }
  jump_ = {.state = state, .at = high_[state], .below = below, .above = above};
  return true;
}

}  // namespace saltus
