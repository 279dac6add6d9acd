// Floor for dopri5: the same method with the same step control, written by hand for two states and
// one falling guard. Everything is inlined and of fixed size. Location is on the dense output, to 2
// eps of the offset in the step.
#pragma once

#include <algorithm>
#include <limits>
#include <saltus/solver/dopri5.hpp>

#include "ball.hpp"

namespace bench {

class FloorDopri5 {
 public:
  FloorDopri5(const Ball& ball, double rtol, double atol) : ball_(ball), rtol_(rtol), atol_(atol) {}

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
        t_ = t1_, x_ = x1_, k_[0] = k_[6];
      }
    }
    out_.y = x_[0], out_.v = x_[1];
  }

  const Outcome& outcome() const { return out_; }

 private:
  using Tableau = saltus::Dopri5;
  using State = std::array<double, 2>;

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
    return std::min(100.0 * h0,
                    largest <= 1e-15 ? std::max(1e-6, h0 * 1e-3) : std::pow(0.01 / largest, 0.2));
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
            0.9 * std::pow(std::max(error, 1e-12), -0.17) * std::pow(before_, 0.04), 0.2, 10.0);
        before_ = std::max(error, 1e-4);
        const double wish = h * (rejected ? std::min(factor, 1.0) : factor);
        h_ = !rejected && h < h_ ? std::max(h_, wish) : wish;
        return;
      }
      h_ = h * std::clamp(0.9 * std::pow(error, -0.2), 0.1, 0.9);
    }
  }

  double try_step(double h) {
    for (std::size_t stage = 1; stage < 7; ++stage) {
      for (std::size_t i = 0; i < 2; ++i) {
        double sum = 0.0;
        for (std::size_t j = 0; j < stage; ++j) sum += Tableau::a[stage][j] * k_[j][i];
        x1_[i] = x_[i] + h * sum;
      }
      rate(x1_, k_[stage]);
    }
    double sum = 0.0;
    for (std::size_t i = 0; i < 2; ++i) {
      double e = 0.0;
      for (std::size_t j = 0; j < 7; ++j) e += Tableau::e[0][j] * k_[j][i];
      e *= h / (atol_ + rtol_ * std::max(std::abs(x_[i]), std::abs(x1_[i])));
      sum += e * e;
    }
    return std::sqrt(0.5 * sum);
  }

  void prepare_dense() {
    for (std::size_t i = 0; i < 2; ++i) {
      const double rise = x1_[i] - x_[i], bend = length_ * k_[0][i] - rise;
      double last = 0.0;
      for (std::size_t j = 0; j < 7; ++j) last += Tableau::d[0][j] * k_[j][i];
      dense_[i] = {rise, bend, rise - length_ * k_[6][i] - bend, length_ * last};
    }
  }
  double dense(std::size_t i, double u) const {
    const double s = u / length_, r = 1.0 - s;
    return x_[i] + s * (dense_[i][0] + r * (dense_[i][1] + s * (dense_[i][2] + r * dense_[i][3])));
  }

  /// Offset of the crossing, by the Illinois method with steps of at least one resolution, so that
  /// both ends of the bracket come to it. The end that is kept is on the floor or below it.
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
  std::array<State, 7> k_ = {};
  std::array<std::array<double, 4>, 2> dense_ = {};
  Outcome out_;
};

}  // namespace bench
