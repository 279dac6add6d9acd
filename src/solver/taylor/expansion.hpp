// Expansion: the power series of the solution at the beginning of a step.
#pragma once

#include <cmath>
#include <type_traits>
#include <utility>
#include <vector>

#include "saltus/plan/detail/flow_variables.hpp"
#include "saltus/tape/series.hpp"

namespace saltus::taylor {

/// Row k has x^(k)(t)/k! of all states.
class Expansion {
 public:
  Expansion(Machine& machine, tape::Series series, int order)
      : machine_(&machine),
        series_(std::move(series)),
        order_(order),
        n_(machine.plan().nx),
        variables_(machine),
        held_(static_cast<std::size_t>(n_)),
        x_(static_cast<std::size_t>(n_ * (order + 1))) {}
  Expansion(const Expansion&) = delete;  // views point into it
  Expansion& operator=(const Expansion&) = delete;

  /// Expands at (t, x); false if a coefficient is not finite. It counts as one call of the
  /// right-hand side.
  bool at(double t, const double* x) {
    ++machine_->rhs_calls;
    variables_.at(t, x, [&](const At& here) { series_.expand(here, order_, held(), x_.data()); });
    const VectorView all(x_.data(), n_ * (order_ + 1));
    return std::isfinite(all.sum()) || all.allFinite();  // a sum of finite numbers may overflow
  }

  int order() const noexcept { return order_; }
  const double* row(int k) const { return x_.data() + k * n_; }
  tape::Series& series() noexcept { return series_; }

  /// out = x0 + (carried + u sum over k = 1 .. order of x^[k] u^(k - 1)), the state at offset u.
  void state(double u, const double* x0, const double* carried, double* out) const {
    for_entries([&]<int W>(Index i, Width<W>) {
      const Block<W> change = horner<W>(i, u).first;
      put<W>(load<W>(x0 + i) + (load<W>(carried + i) + u * change), out + i);
    });
  }
  /// change = x(u) - x0, slope = dx/du.
  void change_and_slope(double u, double* change, double* slope) const {
    for_entries([&]<int W>(Index i, Width<W>) {
      const auto [per_time, bend] = horner<W>(i, u);
      put<W>(u * per_time, change + i);
      put<W>(per_time + u * bend, slope + i);
    });
  }

 private:
  /// The states whose derivative is zero because their block rests; null if there are none.
  const char* held() {
    const RestingStates& resting = machine_->resting();
    if (!resting.any()) return nullptr;
    for (Index i = 0; i < n_; ++i) held_[static_cast<std::size_t>(i)] = resting.rests(i) ? 1 : 0;
    return held_.data();
  }

  /// W entries side by side.
  template <int W>
  using Block = Eigen::Array<double, W, 1>;
  template <int W>
  using Width = std::integral_constant<int, W>;

  /// Calls body for all entries, four at a time, then two, then one.
  template <class Body>
  void for_entries(const Body& body) const {
    Index i = 0;
    for (; i + 4 <= n_; i += 4) body(i, Width<4>());
    for (; i + 2 <= n_; i += 2) body(i, Width<2>());
    for (; i < n_; ++i) body(i, Width<1>());
  }
  template <int W>
  static Block<W> load(const double* from) {
    return Eigen::Map<const Block<W>>(from);
  }
  template <int W>
  static void put(const Block<W>& value, double* to) {
    Eigen::Map<Block<W>>{to} = value;
  }

  /// q(u) = sum over k = 1 .. order of x^[k] u^(k - 1), and dq/du, for W entries from i on.
  template <int W>
  std::pair<Block<W>, Block<W>> horner(Index i, double u) const {
    Block<W> q = load<W>(row(order_) + i), slope = Block<W>::Zero();
    for (int k = order_ - 1; k >= 1; --k) {
      slope = q + u * slope;
      q = load<W>(row(k) + i) + u * q;
    }
    return {q, slope};
  }

  Machine* machine_;
  tape::Series series_;
  int order_;
  Index n_;
  FlowVariables variables_;
  std::vector<char> held_;
  std::vector<double> x_;
};

}  // namespace saltus::taylor
