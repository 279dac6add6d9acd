// ColumnSteps of dopri5 and dop853.
#include "saltus/solver/detail/column_steps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "saltus/solver/detail/dop853.hpp"
#include "saltus/solver/detail/dopri5.hpp"
#include "saltus/solver/detail/step_polynomial.hpp"

namespace saltus {

namespace {

template <Tableau Method>
class ColumnStepsOf final : public ColumnSteps {
 public:
  ColumnStepsOf(Index n, Index m)
      : n_(n),
        size_(n * m),
        x_(as_size(n)),
        s_(as_size(size_)),
        squares_(as_size(m)),
        dense_(size_) {
    k_.assign(Method::rows * as_size(size_), 0.0);
  }

  void step(const StepStages& step, ColumnRate& rate, const double* s0, double* s1,
            bool continues) override {
    if (continues)
      std::copy_n(stage(last), size_, stage(0));
    else
      rate.go_to(step.t0, step.x0), rate.apply(s0, stage(0));
    stages<1, last>(step, rate, s0);
    combine<last>(step.h, s0, k_.data(), size_, s1);
    rate.go_to(step.t1, step.x1), rate.apply(s1, stage(last));
  }

  double state_error(const StepStages& step, const Tolerances& tolerances) override {
    state_squares_.front() = {};
    add_squares(step.h, {step.x0, step.x1, step.k, n_}, tolerances, state_squares_);
    return mean_error(state_squares_.front());
  }

  double error(const StepStages& step, const Tolerances& tolerances, const double* s0,
               const double* s1) override {
    std::ranges::fill(squares_, Squares{});
    add_squares(step.h, {s0, s1, k_.data(), size_}, tolerances, squares_);
    double most = 0.0;
    for (std::size_t k = 0; k < squares_.size(); ++k) {
      const double found = mean_error(squares_[k]);
      if (found > most && std::isfinite(s0[k])) most = found;
    }
    return most;
  }

  void prepare_dense(const StepStages& step, ColumnRate& rate, const double* s0,
                     const double* s1) override {
    stages<Method::stages, Method::rows>(step, rate, s0);
    dense_.set(step.h, s0, s1, k_.data());
  }
  void read(double part, const double* s0, double* s) const override { dense_.read(s0, part, s); }
  int degree() const override { return static_cast<int>(StepPolynomial<Method, 0>::terms); }

 private:
  static constexpr std::size_t last = Method::stages - 1;
  static constexpr std::size_t estimates = Method::e.size();
  using Squares = std::array<double, estimates>;

  static std::size_t as_size(Index n) { return static_cast<std::size_t>(n); }
  double* stage(std::size_t i) { return k_.data() + static_cast<Index>(i) * size_; }

  template <std::size_t First, std::size_t End>
  void stages(const StepStages& step, ColumnRate& rate, const double* s0) {
    if constexpr (First < End) {
      combine<First>(step.h, step.x0, step.k, n_, x_.data());
      combine<First>(step.h, s0, k_.data(), size_, s_.data());
      rate.go_to(step.t0 + Method::c[First] * step.h, x_.data());
      rate.apply(s_.data(), stage(First));
      stages<First + 1, End>(step, rate, s0);
    }
  }

  /// begin + h sum_j a[I][j] k_j, in pairs: the arithmetic of ExplicitStep.
  template <std::size_t I>
  static void combine(double h, const double* begin, const double* k, Index size, double* out) {
    Index i = 0;
    for (; i + 1 < size; i += 2) combine_lane<I, 2>(h, begin + i, k + i, size, out + i);
    if (i < size) combine_lane<I, 0>(h, begin + i, k + i, size, out + i);
  }
  template <std::size_t I, int W>
  static void combine_lane(double h, const double* begin, const double* k, Index size,
                           double* out) {
    constexpr auto row = [] { return Method::a[I]; };
    detail::Lane<W> sum = detail::zero<W>();
    if constexpr (detail::cancels(row()))
      sum = Method::c[I] * detail::load<W>(k) + detail::dot_of_differences<row, I, W>(k, size);
    else
      sum = detail::dot<row, I, W>(k, size);
    detail::store<W>(out, detail::load<W>(begin) + h * sum);
  }

  /// Values with their stages.
  struct Carried {
    const double *from, *to, *k;
    Index size;
  };
  /// Adds the squares of the error estimates, in tolerances, row by row to those of the columns.
  void add_squares(double h, const Carried& of, const Tolerances& tolerances,
                   std::vector<Squares>& columns) const {
    for (Index i = 0; i < of.size;) {
      for (Squares& column : columns) {
        const double size = std::max(std::abs(of.from[i]), std::abs(of.to[i]));
        // An infinite entry has an infinite tolerance: to - to makes its error NaN.
        const double allowed = tolerances.atol[i] + tolerances.rtol * size + (of.to[i] - of.to[i]);
        add_square(h / allowed, of.k + i, of.size, column);
        ++i;
      }
    }
  }
  static void add_square(double scale, const double* k, Index size, Squares& squares) {
    [&]<std::size_t... M>(std::index_sequence<M...>) {
      const Squares of{scale *
                       detail::dot<[] { return Method::e[M]; }, Method::stages, 0>(k, size)...};
      ((squares[M] += of[M] * of[M]), ...);
    }(std::make_index_sequence<estimates>{});
  }
  double mean_error(Squares squares) const {
    for (double& square : squares) square /= static_cast<double>(n_);
    const double found = Method::error(squares);
    return std::isfinite(found) ? found : std::numeric_limits<double>::infinity();
  }

  Index n_, size_;
  std::vector<double> x_, s_, k_;                    // of a stage; of all stages
  std::vector<Squares> squares_, state_squares_{1};  // of each column; of the states
  StepPolynomial<Method, 0> dense_;
};

}  // namespace

template <class Method>
std::unique_ptr<ColumnSteps> make_column_steps(Index n, Index m) {
  return std::make_unique<ColumnStepsOf<Method>>(n, m);
}

template std::unique_ptr<ColumnSteps> make_column_steps<Dopri5>(Index n, Index m);
template std::unique_ptr<ColumnSteps> make_column_steps<Dop853>(Index n, Index m);

}  // namespace saltus
