// The heated rod exactly: the difference operator has the eigenvectors sin(k pi x_i) with the
// eigenvalues -4 kappa (N + 1)^2 sin^2(k pi / (2 (N + 1))), so between two switches each
// coefficient a_k relaxes independently: a_k(t) = r_k + (a_k - r_k) exp(lambda_k (t - begin)), r_k
// = -s_k / lambda_k with the source s_k, or 0. The eigenvalues are in any text on finite
// differences, such as J. W. Thomas, Numerical Partial Differential Equations.
#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "saltus/base/error.hpp"
#include "saltus/report/exact.hpp"

namespace saltus::models {

struct HeatRodProblem {
  Eigen::Index n = 63;           ///< nodes inside, at i L / (n + 1)
  double kappa = 1.0;            ///< [m^2/s]
  double power = 16.0;           ///< [K/s]
  double low = 0.2, high = 0.3;  ///< [K] of the thermostat, low < high
  double t_end = 1.0;            ///< [s]

  Eigen::Index heated() const { return (n + 1) / 2; }            ///< nodes in the coil
  Eigen::Index sensor() const { return (3 * (n + 1)) / 4 - 1; }  ///< place of its node
};

/// The rod from switch to switch, in long double.
class HeatRodModes {
 public:
  explicit HeatRodModes(const HeatRodProblem& problem);

  std::vector<double> switches() const;  ///< [s]
  /// The temperatures at time t after `switches` switches; t may be outside that piece.
  Eigen::VectorXd state(double t, std::size_t switches) const;

 private:
  using Real = long double;
  using Vector = Eigen::Vector<Real, Eigen::Dynamic>;
  struct Piece {
    Real begin;
    Vector rest, away;  // coefficients: a = rest + away exp(lambda (t - begin))
  };

  static Vector at(const Piece& piece, const Vector& lambda, Real t) {
    return piece.rest +
           piece.away.cwiseProduct((lambda * (t - piece.begin)).array().exp().matrix());
  }
  Real sensed(const Piece& piece, Real t) const { return probe_.dot(at(piece, lambda_, t)); }
  Piece follow(Real begin, const Vector& coefficients, bool heating) const;
  Real next_switch(const Piece& piece, bool heating) const;

  HeatRodProblem problem_;
  Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic> sines_;  // sin(k pi x_i): row i, column k
  Vector lambda_, source_, probe_;
  std::vector<Piece> pieces_;
};

inline HeatRodModes::HeatRodModes(const HeatRodProblem& problem) : problem_(problem) {
  const Eigen::Index n = problem.n;
  if (n < 3) throw ModelError(text("heated rod: expected n >= 3 nodes, found ", n));
  if (!(problem.low < problem.high))
    throw ModelError(text("heated rod: expected low < high = ", problem.high,
                          " K, found low = ", problem.low, " K"));
  const Real pi = std::numbers::pi_v<Real>, intervals = static_cast<Real>(n + 1);
  sines_.resize(n, n), lambda_.resize(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const Real s = std::sin(static_cast<Real>(k + 1) * pi / (2 * intervals));
    lambda_[k] = -4 * Real(problem.kappa) * intervals * intervals * s * s;
    for (Eigen::Index i = 0; i < n; ++i)
      sines_(i, k) = std::sin(pi * static_cast<Real>((i + 1) * (k + 1)) / intervals);
  }
  // The sines are orthogonal, with the norm sqrt((n + 1) / 2).
  source_ = sines_.topRows(problem.heated()).colwise().sum().transpose() *
            (2 * Real(problem.power) / intervals);
  probe_ = sines_.row(problem.sensor()).transpose();
  bool heating = true;
  pieces_.push_back(follow(0, Vector::Zero(n), heating));
  for (Real t; (t = next_switch(pieces_.back(), heating)) <= problem.t_end;) {
    heating = !heating;
    pieces_.push_back(follow(t, at(pieces_.back(), lambda_, t), heating));
  }
}

inline HeatRodModes::Piece HeatRodModes::follow(Real begin, const Vector& coefficients,
                                                bool heating) const {
  const Vector rest =
      heating ? Vector(-source_.cwiseQuotient(lambda_)) : Vector::Zero(lambda_.size()).eval();
  return {begin, rest, coefficients - rest};
}

/// The first time at which the sensor reaches its threshold. The search steps by a hundredth of the
/// slowest mode's time, then halves the interval down to rounding. A time after t_end if there is
/// none before.
inline HeatRodModes::Real HeatRodModes::next_switch(const Piece& piece, bool heating) const {
  const auto reached = [&](Real t) {
    return heating ? sensed(piece, t) >= problem_.high : sensed(piece, t) <= problem_.low;
  };
  const Real step = Real(0.01) / -lambda_[0], end = problem_.t_end;
  Real before = piece.begin, after = before + step;
  while (!reached(after)) {
    if (after > end) return 2 * end + 1;
    before = after, after += step;
  }
  for (Real middle; middle = (before + after) / 2, middle > before && middle < after;)
    (reached(middle) ? after : before) = middle;
  return after;
}

inline std::vector<double> HeatRodModes::switches() const {
  std::vector<double> times;
  for (std::size_t i = 1; i < pieces_.size(); ++i)
    times.push_back(static_cast<double>(pieces_[i].begin));
  return times;
}

inline Eigen::VectorXd HeatRodModes::state(double t, std::size_t switches) const {
  const Piece& piece = pieces_[std::min(switches, pieces_.size() - 1)];
  return (sines_ * at(piece, lambda_, t)).cast<double>();
}

namespace detail {

/// The known answer of a scene that records u and whose switches are the events of `guard`.
inline Exact heat_rod_answer(const HeatRodProblem& problem, std::string guard) {
  const auto modes = std::make_shared<const HeatRodModes>(problem);
  return {
      .provenance = "closed form: sine modes of the difference operator, in long double",
      .events = {{std::move(guard), {{.times = modes->switches()}}}},
      .state = [modes](double t, const Branch& branch) { return modes->state(t, branch.events); }};
}

}  // namespace detail

}  // namespace saltus::models
