// Variation: the linear equation of the tangents, S' = A(t) S + b(t), over one solver step.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "saltus/base/view.hpp"

namespace saltus {

/// Advances S by collocation at the Radau points with 5 stages (Radau IIA, order 9, L-stable; E.
/// Hairer, G. Wanner, Solving ODEs II, 2nd ed., Springer 1996, IV.5). The equation is linear, so a
/// step is one linear solve, and stiff equations need nothing else. A step is divided where the
/// polynomial of the collocation misses the equation, between its points, by more than the
/// tolerance.
class Variation {
 public:
  static constexpr int stages = 5;
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  /// A(t), n by n, and b(t), n by m.
  using Equation = std::function<void(double t, Eigen::MatrixXd& a, Eigen::MatrixXd& b)>;
  struct Tolerances {
    double rtol;
    Eigen::MatrixXd atol;  ///< of each entry of S
  };

  /// The nodes of a polynomial, as parts of a step: the begin and the Radau points, or those of a
  /// polynomial of degree 7.
  static constexpr std::size_t few_nodes = stages + 1, most_nodes = 8;
  static std::span<const double> nodes_of(std::size_t count);

  /// S from `from` to `to` [s]: the polynomial through its values at the nodes, or a constant.
  struct Piece {
    double from, to;
    std::vector<Eigen::MatrixXd> s;
    Eigen::MatrixXd at(double t) const;
  };

  explicit Variation(Tolerances tolerances);

  /// Advances S from `from` to `to` [s], and keeps its values in between.
  void advance(double from, double to, const Equation& equation, Eigen::MatrixXd& s);
  /// Keeps values that were found elsewhere.
  void keep(Piece piece) { pieces_.push_back(std::move(piece)); }
  /// Forgets the values in between.
  void forget() { pieces_.clear(); }
  /// S at a time within the steps since `forget`; false if there were none around it.
  bool at(double t, Eigen::MatrixXd& s) const;
  /// The values in between: one polynomial after the other.
  const std::vector<Piece>& pieces() const noexcept { return pieces_; }

 private:
  /// How often a step was divided, and the error of the piece before the last time [tolerances].
  struct Halving {
    int depth = 0;
    double error = 0.0;
  };
  void advance(double from, double to, const Equation& equation, Eigen::MatrixXd& s,
               Halving halving);
  Piece collocate(double from, double to, const Equation& equation, const Eigen::MatrixXd& s);
  double error_of(const Piece& piece, const Equation& equation);

  Tolerances tolerances_;
  std::vector<Piece> pieces_;
  std::vector<Eigen::MatrixXd> a_, b_;
  Rows system_;  // with its right-hand sides behind it
};

}  // namespace saltus
