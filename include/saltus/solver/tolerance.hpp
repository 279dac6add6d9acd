// Tolerance: how large an error of a step may be, for all states or for each.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <utility>
#include <vector>

#include "saltus/base/list.hpp"
#include "saltus/base/view.hpp"

namespace saltus {

/// A relative or an absolute tolerance: one number for all states, or one number for each
/// continuous state of the system, in the order of the context.
class Tolerance {
 public:
  Tolerance(double every) : every_(every) {}
  Tolerance(std::vector<double> each) : each_(std::move(each)), by_state_(true) {}
  Tolerance(std::initializer_list<double> each) : Tolerance(std::vector<double>(each)) {}

  /// That of state i.
  double operator[](Index i) const { return by_state_ ? each_[i] : every_; }
  /// Whether each state has its own.
  bool by_state() const noexcept { return by_state_; }
  /// The numbers, one for each state; empty if one number is for all.
  const std::vector<double>& each() const noexcept { return each_; }
  double smallest() const {
    if (!by_state_) return every_;
    return each_.empty() ? 1.0 : *std::ranges::min_element(each_);
  }
  Tolerance& operator*=(double factor) {
    every_ *= factor;
    for (double& tolerance : each_) tolerance *= factor;
    return *this;
  }
  /// One number in place of all: the smallest.
  operator double() const { return smallest(); }

 private:
  double every_ = 0.0;
  List<double> each_;
  bool by_state_ = false;
};

}  // namespace saltus
