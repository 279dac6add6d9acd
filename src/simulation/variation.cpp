// Variation: the collocation, its error and its values in between.
#include "saltus/simulation/detail/variation.hpp"

#include <array>
#include <cmath>
#include <span>

#include <Eigen/LU>

#include "saltus/simulation/detail/thresholds.hpp"

namespace saltus {

namespace {

constexpr int stages = Variation::stages;
constexpr int points = stages + 1;
/// The begin of a step and the Radau points, as parts of it.
constexpr std::array<double, points> radau_points{
    0.0, 0.05710419611451768, 0.27684301363812383, 0.5835904323689168, 0.8602401356562195, 1.0};
/// The begin of a step, the extrema of a Chebyshev polynomial of degree 7, and its end.
constexpr std::array<double, Variation::most_nodes> many_nodes{0.0,
                                                               0.04951556604879043,
                                                               0.1882550990706332,
                                                               0.3887395330218428,
                                                               0.6112604669781572,
                                                               0.8117449009293667,
                                                               0.9504844339512096,
                                                               1.0};
/// Where the polynomial is compared with the equation: far from the points.
constexpr double looked_at = 0.72;
/// A step is halved so often at most. The polynomial has degree 5, so ten halvings reduce its error
/// by 2^50, which is the rounding.
constexpr int most_halvings = 10;
/// From this depth on a piece is divided only as long as its error falls: an order of 5 divides it by
/// 32 where it resolves the equation, and rounding does not fall. A shorter pulse is searched first.
constexpr int searched_halvings = 4;
constexpr double falling_share = 0.5;
/// The rounding of A S and of the differences in A, in parts of the largest value of a column.
constexpr double value_rounding = 1e3 * thresholds::eps;

/// The Lagrange polynomial of node i at s, without the factor of node `but`.
double basis(std::span<const double> nodes, std::size_t i, double s, std::size_t but) {
  double product = 1.0;
  for (std::size_t j = 0; j < nodes.size(); ++j) {
    if (j != i && j != but) product *= (s - nodes[j]) / (nodes[i] - nodes[j]);
  }
  return product;
}
double basis(int i, double s, int but) {
  return basis(radau_points, static_cast<std::size_t>(i), s, static_cast<std::size_t>(but));
}
/// Its derivative.
double slope(int i, double s) {
  double sum = 0.0;
  for (int m = 0; m < points; ++m) {
    if (m != i) sum += basis(i, s, m) / (radau_points[i] - radau_points[m]);
  }
  return sum;
}

/// slope(j, node i + 1), which the collocation multiplies its values by.
const std::array<std::array<double, points>, stages>& slopes_at_nodes() {
  static const auto made = [] {
    std::array<std::array<double, points>, stages> all{};
    for (int i = 0; i < stages; ++i) {
      for (int j = 0; j < points; ++j) all[i][j] = slope(j, radau_points[i + 1]);
    }
    return all;
  }();
  return made;
}

using Weights = std::array<double, points>;

Weights bases_at(double part) {
  Weights all{};
  for (int j = 0; j < points; ++j) all[j] = basis(j, part, -1);
  return all;
}
Weights slopes_at(double part) {
  Weights all{};
  for (int j = 0; j < points; ++j) all[j] = slope(j, part);
  return all;
}

/// sum_j weights_j s_j
Eigen::MatrixXd sum(const std::vector<Eigen::MatrixXd>& s, const Weights& weights) {
  Eigen::MatrixXd out = weights[0] * s[0];
  for (std::size_t j = 1; j < points; ++j) out += weights[j] * s[j];
  return out;
}

/// Up to so many unknowns the elimination by rows is quicker than Eigen's by blocks: 24 000 in place of
/// 43 000 instructions for 20 unknowns and one right-hand side.
constexpr Index most_by_rows = 64;

/// Gaussian elimination with row pivoting of n equations; the right-hand sides, which become the
/// solutions, are the other columns. The zeros of the coupling between points are skipped.
void eliminate(Variation::Rows& all) {
  const Index n = all.rows(), columns = all.cols();
  for (Index k = 0; k < n; ++k) {
    Index pivot = k;
    for (Index i = k + 1; i < n; ++i)
      if (std::abs(all(i, k)) > std::abs(all(pivot, k))) pivot = i;
    if (pivot != k) all.row(k).tail(columns - k).swap(all.row(pivot).tail(columns - k));
    const double* from = &all(k, 0);
    for (Index i = k + 1; i < n; ++i) {
      double* to = &all(i, 0);
      if (to[k] == 0.0) continue;
      const double factor = to[k] / from[k];
      for (Index j = k + 1; j < columns; ++j) to[j] -= factor * from[j];
    }
  }
}

/// The solutions of the equations that `eliminate` has made triangular.
void substitute_back(Variation::Rows& all) {
  const Index n = all.rows(), columns = all.cols();
  for (Index k = n - 1; k >= 0; --k) {
    double* to = &all(k, 0);
    for (Index i = k + 1; i < n; ++i) {
      const double factor = to[i];
      const double* from = &all(i, 0);
      if (factor == 0.0) continue;
      for (Index j = n; j < columns; ++j) to[j] -= factor * from[j];
    }
    for (Index j = n; j < columns; ++j) to[j] /= to[k];
  }
}

/// Solves a linear system, which has its right-hand sides as further columns and is overwritten.
Eigen::MatrixXd solved(Variation::Rows& all) {
  const Index n = all.rows(), m = all.cols() - n;
  if (n > most_by_rows) return all.leftCols(n).partialPivLu().solve(all.rightCols(m));
  eliminate(all), substitute_back(all);
  return all.rightCols(m);
}

}  // namespace

std::span<const double> Variation::nodes_of(std::size_t count) {
  if (count == many_nodes.size()) return many_nodes;
  return radau_points;
}

Variation::Variation(Tolerances tolerances)
    : tolerances_(std::move(tolerances)), a_(stages), b_(stages) {}

void Variation::advance(double from, double to, const Equation& equation, Eigen::MatrixXd& s) {
  if (s.rows() > 0 && to > from) advance(from, to, equation, s, {});
}

void Variation::advance(double from, double to, const Equation& equation, Eigen::MatrixXd& s,
                        Halving halving) {
  Piece piece = collocate(from, to, equation, s);
  const double middle = from + 0.5 * (to - from);
  if (halving.depth < most_halvings && from < middle && middle < to) {
    const double error = error_of(piece, equation);
    const bool falls = halving.depth < searched_halvings || error <= falling_share * halving.error;
    if (error > 1.0 && falls) {
      const Halving next{halving.depth + 1, error};
      advance(from, middle, equation, s, next);
      return advance(middle, to, equation, s, next);
    }
  }
  s = piece.s.back();
  pieces_.push_back(std::move(piece));
}

/// Solves sum_j slope_ij S_j = h (A_i S_i + b_i) at the points i for the values S_j there.
Variation::Piece Variation::collocate(double from, double to, const Equation& equation,
                                      const Eigen::MatrixXd& s) {
  const Index n = s.rows();
  const double h = to - from;
  system_.setZero(stages * n, stages * n + s.cols());
  for (int i = 0; i < stages; ++i) {
    const auto& row = slopes_at_nodes()[i];
    const auto k = static_cast<std::size_t>(i);
    equation(i + 1 == stages ? to : from + radau_points[i + 1] * h, a_[k], b_[k]);
    for (int j = 0; j < stages; ++j)
      system_.block(i * n, j * n, n, n).diagonal().setConstant(row[j + 1]);
    system_.block(i * n, i * n, n, n) -= h * a_[k];
    system_.block(i * n, stages * n, n, s.cols()) = h * b_[k] - row[0] * s;
  }
  const Eigen::MatrixXd found = solved(system_);
  Piece piece{from, to, {s}};
  for (int i = 0; i < stages; ++i) piece.s.emplace_back(found.middleRows(i * n, n));
  return piece;
}

/// By how many tolerances the polynomial misses the equation at the place that is looked at. The miss
/// d is damped by (1 - h A)^-1, because a stiff equation turns a small error of S into a large one of
/// A S (E. Hairer, G. Wanner, IV.8). A value that is not finite counts as 0: shorter steps cannot make
/// it good.
double Variation::error_of(const Piece& piece, const Equation& equation) {
  const double h = piece.to - piece.from;
  equation(piece.from + looked_at * h, a_[0], b_[0]);
  static const Weights bases = bases_at(looked_at), slopes = slopes_at(looked_at);
  const Eigen::MatrixXd here = sum(piece.s, bases);
  const Index n = here.rows();
  system_.resize(n, n + here.cols());
  system_.leftCols(n) = Eigen::MatrixXd::Identity(n, n) - h * a_[0];
  system_.rightCols(here.cols()) = sum(piece.s, slopes) - h * (a_[0] * here + b_[0]);
  const Eigen::MatrixXd error = solved(system_);
  double most = 0.0;
  for (Index k = 0; k < here.cols(); ++k) {
    const double least = value_rounding * here.col(k).lpNorm<Eigen::Infinity>();
    for (Index i = 0; i < n; ++i) {
      const double size = std::max(std::abs(piece.s.front()(i, k)), std::abs(piece.s.back()(i, k)));
      const double allowed = tolerances_.atol(i, k) + tolerances_.rtol * size + least;
      most = std::max(most, std::abs(error(i, k)) / allowed);
    }
  }
  return most;
}

Eigen::MatrixXd Variation::Piece::at(double t) const {
  if (s.size() == 1) return s.front();
  const double part = (t - from) / (to - from);
  const std::span<const double> nodes = nodes_of(s.size());
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(s.front().rows(), s.front().cols());
  for (std::size_t j = 0; j < s.size(); ++j) out += basis(nodes, j, part, s.size()) * s[j];
  return out;
}

bool Variation::at(double t, Eigen::MatrixXd& s) const {
  for (const Piece& piece : pieces_) {
    if (!(piece.from <= t && t <= piece.to)) continue;
    s = piece.at(t);
    return true;
  }
  return false;
}

}  // namespace saltus
