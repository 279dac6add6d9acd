// The closed form of a linear circuit x' = A x + b whose rates may lie ten decades apart, in long
// double. It gives the answers of stiff scenes that are linear from event to event.
#pragma once

#include <complex>

#include "saltus/base/ids.hpp"
#include "saltus/models/pieces.hpp"

namespace saltus::models {

class LinearFlow {
 public:
  using Vector = Eigen::Vector<Real, Eigen::Dynamic>;
  using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

  /// A has no eigenvalue 0 and no multiple one. Fast eigenvalues are those of A and slow ones those
  /// of its inverse, so that each has its own rounding and not that of the fastest.
  LinearFlow(const Matrix& a, const Vector& b);

  /// The state `duration` [s] after `from`.
  Vector at(Real duration, const Vector& from) const;
  const Vector& rest() const { return rest_; }

 private:
  using Complex = std::complex<Real>;
  using ComplexMatrix = Eigen::Matrix<Complex, Eigen::Dynamic, Eigen::Dynamic>;

  Vector rest_;                                   // the state at which A x + b = 0
  Eigen::Vector<Complex, Eigen::Dynamic> rates_;  // eigenvalues [1/s]
  ComplexMatrix modes_, into_modes_;
};

/// A piece of a trajectory in one mode of a circuit.
struct LinearPiece {
  Real begin;
  LinearFlow::Vector from;
  std::shared_ptr<const LinearFlow> flow;
  int mode;
  Real layer = 0;  ///< [s] rows so soon after the begin are those of the event itself

  LinearFlow::Vector at(Real t) const { return flow->at(t - begin, from); }
  /// A row of the event is compared with the state at the event, however early or late it was
  /// found: in the layer behind it an error of time would be one of the state a million times as
  /// large, and before it the fast modes would explode backwards.
  Eigen::VectorXd state(Real t) const {
    return LinearFlow::Vector(t - begin <= layer ? from : at(t)).cast<double>();
  }
};

/// The first change of sign of f after `begin`, up to `end`, in steps that grow from `least`: f may
/// change at once after an event, or slowly until the next one.
template <class Function>
std::optional<Real> first_change(const Function& f, Real begin, Real least, Real end) {
  Real before = least;
  const bool above = f(begin + before) > 0;
  while (begin + before < end) {
    const Real after = std::min(before * Real(1.1), end - begin);
    if ((f(begin + after) > 0) != above) return root_between(f, begin + before, begin + after);
    if (begin + after >= end) return {};
    before = after;
  }
  return {};
}

/// The middles of the pieces longer than `least` [s], up to `end`: the times of the rows of a
/// scene. A row before a quarter of such a piece is then a row of its event, and its layer.
inline std::vector<double> mark_layers(ExactPieces<LinearPiece>& all, Real least, double end) {
  std::vector<double> middles;
  for (std::size_t k = 0; k < all.pieces.size(); ++k) {
    LinearPiece& piece = all.pieces[k];
    const Real stop = k + 1 < all.pieces.size() ? all.pieces[k + 1].begin : Real(end);
    if (stop - piece.begin <= least) continue;
    piece.layer = (stop - piece.begin) / 4;
    middles.push_back(static_cast<double>((piece.begin + stop) / 2));
  }
  return middles;
}

}  // namespace saltus::models
