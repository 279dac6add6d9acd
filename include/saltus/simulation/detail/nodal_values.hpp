// NodalValues: polynomials in one number, by their values at Chebyshev points.
#pragma once

#include <cstddef>

#include <Eigen/Core>

#include "saltus/base/ids.hpp"
#include "saltus/base/list.hpp"

namespace saltus {

/// Vectors, one after another, of which d + 1 are the values of a polynomial of degree d at the
/// Chebyshev points of [0, 1]. They determine it. It is read by the barycentric formula (J.-P.
/// Berrut, L. N. Trefethen, "Barycentric Lagrange interpolation", SIAM Review 46 (2004), pp. 504
/// and 507), exact at these points and as stable as the values themselves (N. J. Higham, IMA J.
/// Numer. Anal. 24 (2004) 547).
class NodalValues {
 public:
  /// Of vectors of this size.
  explicit NodalValues(Index size = 0) : size_(size) {}

  /// Point k of a polynomial: 0 for the first, 1 for the last.
  static double node(int k, int degree);

  Index size() const noexcept { return size_; }
  /// Keeps one vector, and returns its place.
  std::size_t put(const Eigen::VectorXd& x);
  /// Makes room for a polynomial, and returns its place.
  std::size_t add(int degree);
  /// The place of value k of the polynomial at a place.
  std::size_t place(std::size_t first, int k) const {
    return first + static_cast<std::size_t>(k * size_);
  }
  /// The vector at a place; valid until the next `put` or `add`.
  double* at(std::size_t place) { return values_.data() + place; }

  /// Writes the polynomial at a place, at s in [0, 1], to x.
  void polynomial(std::size_t first, int degree, double s, double* x) const;
  std::size_t bytes() const noexcept { return values_.size() * sizeof(double); }

 private:
  Index size_;
  List<double> values_;
};

}  // namespace saltus
