// Gaussian elimination with partial pivoting, for a fixed number of states or any.
#pragma once

#include <algorithm>

#include "factorisation.hpp"
#include "saltus/base/list.hpp"
#include "saltus/solver/detail/linear_thresholds.hpp"
#include "scalar.hpp"

namespace saltus {

/// Factorises in place, column by column (G. H. Golub, C. F. Van Loan, Matrix Computations, 4th
/// ed., algorithm 3.4.1). The diagonal keeps the reciprocals of the pivots. With a fixed size the
/// compiler unrolls the loops; size 0 is known at run time only.
template <int fixed, class T>
class Elimination final : public FactorisationOf<T> {
 public:
  explicit Elimination(int n) : n_(n), pivots_(n) {}

  bool factor(T* a) override {
    a_ = a;
    for (int k = 0; k < n(); ++k) {
      T* column = a + k * n();
      int best = k;
      for (int i = k + 1; i < n(); ++i)
        if (size_of(column[i]) > size_of(column[best])) best = i;
      pivots_[k] = best;
      if (!(size_of(column[best]) > 0.0)) return false;
      if (best != k)
        for (int j = 0; j < n(); ++j) std::swap(a[k + j * n()], a[best + j * n()]);
      column[k] = reciprocal(column[k]);
      for (int i = k + 1; i < n(); ++i) column[i] = product(column[i], column[k]);
      for (int j = k + 1; j < n(); ++j) {
        T* other = a + j * n();
        const T factor = other[k];
        for (int i = k + 1; i < n(); ++i) other[i] -= product(factor, column[i]);
      }
    }
    return true;
  }

  void solve(T* b) override {
    for (int k = 0; k < n(); ++k) std::swap(b[k], b[pivots_[k]]);
    for (int k = 0; k < n(); ++k) {
      for (int i = k + 1; i < n(); ++i) b[i] -= product(a_[i + k * n()], b[k]);
    }
    for (int k = n() - 1; k >= 0; --k) {
      b[k] = product(b[k], a_[k + k * n()]);
      for (int i = 0; i < k; ++i) b[i] -= product(a_[i + k * n()], b[k]);
    }
  }

 private:
  constexpr int n() const { return fixed > 0 ? fixed : n_; }

  int n_;
  T* a_ = nullptr;
  List<int> pivots_;
};

/// Unrolled elimination for 1 to thresholds::unrolled_dense states.
template <class T>
std::unique_ptr<FactorisationOf<T>> make_unrolled(int n);

}  // namespace saltus
