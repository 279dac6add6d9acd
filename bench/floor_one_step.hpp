// Floors for dopri5 and dop853: the same methods with the same step control, written by hand for
// two states and one falling guard. Everything is inlined and of fixed size, sums without the terms
// that are zero. Events are located on the dense output, which is computed only if needed, to 2 eps
// of the offset in the step.
#pragma once

#include <algorithm>
#include <limits>
#include <saltus/solver/detail/dop853.hpp>
#include <saltus/solver/detail/dopri5.hpp>
#include <utility>

#include "ball.hpp"

namespace bench {

template <class Tableau>
class FloorOneStep {
 public:
  FloorOneStep(const Ball& ball, double rtol, double atol)
      : ball_(ball), rtol_(rtol), atol_(atol) {}

  void operator()() {
    out_ = {};
    t_ = 0.0, x_ = {ball_.y0, 0.0}, before_ = 1e-4;
    rate(x_, k_[0]);
    h_ = first_step();
    while (t_ < ball_.t_end) {
      step();
      ++out_.guard_calls;
      if (x1_[0] <= 0.0 && (x_[0] > 0.0 || x_[1] > 0.0)) {
        bounce();
      } else {
        t_ = t1_, x_ = x1_, k_[0] = k_[last];
      }
    }
    out_.y = x_[0], out_.v = x_[1];
  }

  const Outcome& outcome() const { return out_; }

 private:
  using State = std::array<double, 2>;
  static constexpr std::size_t last = Tableau::stages - 1, terms = 3 + Tableau::d.size();
  static constexpr double power = 1.0 / Tableau::error_order - 0.75 * Tableau::beta;
  static constexpr bool estimate_reads_end = Tableau::e[0][last] != 0.0;

  void rate(const State& x, State& xdot) {
    ++out_.right_hand_side_calls;
    ball_.derivative(x.data(), xdot.data());
  }

  /// Hairer, Norsett, Wanner I, p. 169.
  double first_step() {
    const auto norm = [&](const State& value) {
      double sum = 0.0;
      for (std::size_t i = 0; i < 2; ++i) {
        const double part = value[i] / (atol_ + rtol_ * std::abs(x_[i]));
        sum += part * part;
      }
      return std::sqrt(0.5 * sum);
    };
    const double d0 = norm(x_), d1 = norm(k_[0]),
                 h0 = d0 < 1e-5 || d1 < 1e-5 ? 1e-6 : 0.01 * d0 / d1;
    State x{x_[0] + h0 * k_[0][0], x_[1] + h0 * k_[0][1]};
    rate(x, k_[1]);
    const double d2 = norm({k_[1][0] - k_[0][0], k_[1][1] - k_[0][1]}) / h0,
                 largest = std::max(d1, d2);
    return std::min(100.0 * h0, largest <= 1e-15
                                    ? std::max(1e-6, h0 * 1e-3)
                                    : std::pow(0.01 / largest, 1.0 / Tableau::error_order));
  }

  void step() {
    const double left = ball_.t_end - t_;
    for (bool rejected = false;; rejected = true) {
      const bool ends = h_ >= left;
      const double h = ends ? left : 2.0 * h_ > left ? 0.5 * left : h_;
      const double error = try_step(h);
      t1_ = ends ? ball_.t_end : t_ + h;
      if (error <= 1.0) {
        ++out_.steps;
        length_ = h;
        const double factor = std::clamp(
            0.9 * std::pow(std::max(error, 1e-12), -power) * std::pow(before_, Tableau::beta),
            Tableau::shortest, Tableau::longest);
        before_ = std::max(error, 1e-4);
        const double wish = h * (rejected ? std::min(factor, 1.0) : factor);
        h_ = !rejected && h < h_ ? std::max(h_, wish) : wish;
        return;
      }
      h_ = h * std::clamp(0.9 * std::pow(error, -1.0 / Tableau::error_order), 0.1, 0.9);
    }
  }

  /// sum_j row[j] k_j[i]; `row` is a lambda, because a coefficient must be a constant.
  template <std::size_t End, class Coefficients>
  double sum(Coefficients row, std::size_t i) const {
    double sum = 0.0;
    const auto add = [&]<std::size_t J>() {
      if constexpr (row()[J] != 0.0) sum += row()[J] * k_[J][i];
    };
    [&]<std::size_t... J>(std::index_sequence<J...>) {
      (add.template operator()<J>(), ...);
    }(std::make_index_sequence<End>{});
    return sum;
  }
  template <std::size_t Stage>
  void stage(double h, const State& x0, State& x) {
    for (std::size_t i = 0; i < 2; ++i)
      x[i] = x0[i] + h * sum<Stage>([] { return Tableau::a[Stage]; }, i);
    if (estimate_reads_end || Stage != last) rate(x, k_[Stage]);
  }
  template <std::size_t First, std::size_t End>
  void stages(double h, State& x) {
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      (stage<First + I>(h, x_, x), ...);
    }(std::make_index_sequence<End - First>{});
  }

  double try_step(double h) {
    stages<1, Tableau::stages>(h, x1_);
    const double error = scaled_error(h);
    if (!estimate_reads_end && error <= 1.0) rate(x1_, k_[last]);
    return error;
  }
  double scaled_error(double h) const {
    std::array<double, Tableau::e.size()> squares{};
    for (std::size_t i = 0; i < 2; ++i) {
      const double scale = h / (atol_ + rtol_ * std::max(std::abs(x_[i]), std::abs(x1_[i])));
      const auto add = [&]<std::size_t M>() {
        const double e = scale * sum<Tableau::stages>([] { return Tableau::e[M]; }, i);
        squares[M] += 0.5 * e * e;
      };
      [&]<std::size_t... M>(std::index_sequence<M...>) {
        (add.template operator()<M>(), ...);
      }(std::make_index_sequence<Tableau::e.size()>{});
    }
    return Tableau::error(squares);
  }

  void prepare_dense() {
    State x;
    stages<Tableau::stages, Tableau::rows>(length_, x);
    for (std::size_t i = 0; i < 2; ++i) {
      const double rise = x1_[i] - x_[i], bend = length_ * k_[0][i] - rise;
      dense_[i][0] = rise, dense_[i][1] = bend;
      dense_[i][2] = rise - length_ * k_[last][i] - bend;
      [&]<std::size_t... M>(std::index_sequence<M...>) {
        ((dense_[i][3 + M] = length_ * sum<Tableau::rows>([] { return Tableau::d[M]; }, i)), ...);
      }(std::make_index_sequence<Tableau::d.size()>{});
    }
  }
  /// x0 + s (c0 + r (c1 + s (c2 + r ...))), s = u / h, r = 1 - s.
  double dense(std::size_t i, double u) const {
    const double s = u / length_, r = 1.0 - s;
    double value = dense_[i][terms - 1];
    for (std::size_t m = terms - 1; m > 0; --m)
      value = dense_[i][m - 1] + (m % 2 == 1 ? r : s) * value;
    return x_[i] + s * value;
  }

  /// The offset of the crossing, by the Illinois method with steps of at least one resolution, so
  /// that both ends of the bracket converge to it. The end that is returned is on the floor or
  /// below it.
  double locate() {
    double low = 0.0, high = length_, a = x_[0], b = x1_[0];
    if (x_[1] > 0.0) {  // it flies up, perhaps from the floor: begin where it is clearly above
      for (a = 0.0, low = length_; a <= 0.0;) low *= 0.5, a = height(low);
    }
    for (int kept = 0;;) {
      const double resolution = 2.0 * std::numeric_limits<double>::epsilon() * high;
      if (high - low <= resolution || b == 0.0) return high;
      double u = low + (high - low) * a / (a - b);
      u = high - low > 3.0 * resolution ? std::clamp(u, low + resolution, high - resolution)
                                        : low + 0.5 * (high - low);
      if (!(u > low && u < high)) return high;
      const double y = height(u);
      if (y <= 0.0) {
        high = u, b = y;
        a *= kept == 1 ? 0.5 : 1.0, kept = 1;
      } else {
        low = u, a = y;
        b *= kept == 2 ? 0.5 : 1.0, kept = 2;
      }
    }
  }
  double height(double u) {
    ++out_.guard_calls;
    return dense(0, u);
  }

  void bounce() {
    prepare_dense();
    const double u = locate();
    const State at{dense(0, u), dense(1, u)};
    t_ += u;
    out_.bounced(t_);
    x_ = {std::abs(at[0]), -ball_.e * at[1]};
    rate(x_, k_[0]);
  }

  Ball ball_;
  double rtol_, atol_;
  double t_ = 0.0, t1_ = 0.0, h_ = 0.0, length_ = 0.0, before_ = 1e-4;
  State x_ = {}, x1_ = {};
  std::array<State, Tableau::rows> k_ = {};
  std::array<std::array<double, terms>, 2> dense_ = {};
  Outcome out_;
};

using FloorDopri5 = FloorOneStep<saltus::Dopri5>;
using FloorDop853 = FloorOneStep<saltus::Dop853>;

}  // namespace bench
