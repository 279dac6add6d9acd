// Gaussian elimination with partial pivoting within a band.
#include <algorithm>

#include "factorisation.hpp"
#include "saltus/base/list.hpp"
#include "scalar.hpp"

namespace saltus {

namespace {

/// Entry (i, j) is at offset lower + upper + i - j of column j; `lower` rows above the band take
/// the entries that pivoting adds (LAPACK's layout and dgbtf2: E. Anderson et al., LAPACK Users'
/// Guide, 3rd ed., 1999, section 5.3.3). The diagonal keeps the reciprocals of the pivots.
template <class T>
class Band final : public FactorisationOf<T> {
 public:
  Band(Index n, Bandwidth band, std::vector<int> position)
      : n_(n),
        lower_(band.lower),
        reach_(band.lower + band.upper),
        height_(reach_ + band.lower + 1),
        upper_(band.upper),
        pivots_(n),
        position_(std::move(position)),
        moved_(position_.size()) {}

  bool factor(T* a) override {
    a_ = a;
    filled_ = upper_;
    Index last = 0;  // the last column of the rows so far
    for (Index j = 0; j < n_; ++j) {
      T* column = diagonal(j);
      const Index below = std::min(lower_, n_ - 1 - j);
      Index best = 0;
      for (Index i = 1; i <= below; ++i)
        if (size_of(column[i]) > size_of(column[best])) best = i;
      pivots_[j] = best;
      filled_ = std::max(filled_, upper_ + best);
      if (!(size_of(column[best]) > 0.0)) return false;
      last = std::max(last, std::min(j + upper_ + best, n_ - 1));
      if (best != 0)
        for (Index k = j; k <= last; ++k) std::swap(diagonal(k)[j - k], diagonal(k)[j - k + best]);
      column[0] = reciprocal(column[0]);
      for (Index i = 1; i <= below; ++i) column[i] = product(column[i], column[0]);
      for (Index k = j + 1; k <= last; ++k) {
        T* other = diagonal(k) + (j - k);
        const T factor = other[0];
        for (Index i = 1; i <= below; ++i) other[i] -= product(factor, column[i]);
      }
    }
    return true;
  }

  void solve(T* b) override {
    if (position_.empty()) return solve_in_place(b);
    for (std::size_t i = 0; i < moved_.size(); ++i) moved_[position_[i]] = b[i];
    solve_in_place(moved_.data());
    for (std::size_t i = 0; i < moved_.size(); ++i) b[i] = moved_[position_[i]];
  }

 private:
  T* diagonal(Index j) const { return a_ + j * height_ + reach_; }

  void solve_in_place(T* b) const {
    for (Index j = 0; j < n_; ++j) {
      const Index pivot = pivots_[j];
      if (pivot != 0) std::swap(b[j], b[j + pivot]);
      const T* column = diagonal(j);
      const Index below = std::min(lower_, n_ - 1 - j);
      for (Index i = 1; i <= below; ++i) b[j + i] -= product(column[i], b[j]);
    }
    for (Index j = n_ - 1; j >= 0; --j) {
      const T* column = diagonal(j);
      b[j] = product(b[j], column[0]);
      const Index above = std::min(filled_, j);
      for (Index i = 1; i <= above; ++i) b[j - i] -= product(column[-i], b[j]);
    }
  }

  Index n_, lower_, reach_, height_, upper_;
  Index filled_ = 0;  // rows above the diagonal that pivoting has reached; those beyond are zero
  T* a_ = nullptr;
  List<Index> pivots_;
  std::vector<int> position_;  // of each state; empty: natural order
  List<T> moved_;
};

}  // namespace

MatrixLayout band_layout(const Sparsity& places, Bandwidth band, const std::vector<int>& position) {
  const Index n = places.columns(), reach = band.lower + band.upper,
              height = reach + band.lower + 1;
  const auto at = [&](Index i) { return position.empty() ? i : Index{position[i]}; };
  MatrixLayout layout{.size = n * height, .places = {}, .diagonal = {}};
  for (Index j = 0; j < n; ++j) {
    const Index diagonal = at(j) * height + reach;
    for (const int i : places.column(j)) layout.places.push_back(diagonal + at(i) - at(j));
    layout.diagonal.push_back(diagonal);
  }
  return layout;
}

template <class T>
std::unique_ptr<FactorisationOf<T>> make_band(Index n, Bandwidth band, std::vector<int> position) {
  return std::make_unique<Band<T>>(n, band, std::move(position));
}
template std::unique_ptr<FactorisationOf<double>> make_band(Index, Bandwidth, std::vector<int>);
template std::unique_ptr<FactorisationOf<Complex>> make_band(Index, Bandwidth, std::vector<int>);

}  // namespace saltus
