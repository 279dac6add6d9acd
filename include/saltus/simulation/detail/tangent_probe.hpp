// TangentProbe: derivatives of functions of a machine along a direction, by central differences.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "saltus/plan/detail/machine.hpp"
#include "saltus/simulation/detail/thresholds.hpp"

namespace saltus {

/// How the values of a machine change with one parameter.
struct TangentDirection {
  double t = 0.0;                                         ///< of the time
  const double *x = nullptr, *z = nullptr, *y = nullptr;  ///< null: zero
  Index parameter = -1;                                   ///< an entry of p that changes by 1
};

/// A second machine beside that of a run. It takes the values of the run, moved along a direction
/// to both sides, and so the machine of the run is never touched.
class TangentProbe {
 public:
  explicit TangentProbe(const Machine& machine)
      : machine_(&machine), probe_(machine.shared_plan()) {
    begin();
  }
  /// A run begins: no size is known.
  void begin();

  /// The machine with the values of the run, moved by `shift` along the direction.
  Machine& at(const double* x, const TangentDirection& along, double shift);
  /// The same without a shift.
  Machine& at(const double* x) { return at(x, {}, 0.0); }

  /// Notes how large the values are, and how long a step is [s].
  void note(const double* x, double step);

  /// d out along the direction at (t, x). `read(machine, shift, out)` computes `size` numbers on a
  /// machine that is moved; the time and all that the machine does not have it moves by itself.
  template <class Read>
  void derivative(const double* x, const TangentDirection& along, Index size, const Read& read,
                  double* out) {
    const double shift = shift_of(x, along);
    if (!(shift > 0.0)) return fill(out, size, std::isnan(shift) ? nan : 0.0);
    near_.resize(size), wide_.resize(size);
    difference(x, along, wide_shift * shift, read, near_);
    difference(x, along, 2.0 * wide_shift * shift, read, wide_);
    if (!agree()) difference(x, along, small_shift * shift, read, near_), wide_ = near_;
    for (Index i = 0; i < size; ++i) out[i] = near_[i] + (near_[i] - wide_[i]) / 3.0;
  }

  /// dxdot along the direction. States at rest do not move.
  void flow(double t, const double* x, const TangentDirection& along, double* out);
  /// The derivative itself, without a shift.
  void flow(double t, const double* x, double* xdot);

 private:
  static constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  /// Differences to u and 2 u together have the error u^4 / 30 by the fifth derivative, and eps / u
  /// by rounding: both are below 1e-12 for this relative shift.
  static constexpr double wide_shift = 1e-3;
  /// One difference has the error u^2 / 6 and eps / u: they are equal near u = eps^(1/3).
  static constexpr double small_shift = 6e-6;
  static void fill(double* out, Index size, double value) { std::fill_n(out, size, value); }
  template <class Read>
  void difference(const double* x, const TangentDirection& along, double shift, const Read& read,
                  Eigen::VectorXd& out) {
    up_.resize(out.size()), down_.resize(out.size());
    read(at(x, along, shift), shift, up_.data());
    read(at(x, along, -shift), -shift, down_.data());
    out = (up_ - down_) / (2.0 * shift);
  }
  bool agree() const;
  double shift_of(const double* x, const TangentDirection& along) const;
  void let_rest(double* xdot) const;

  const Machine* machine_;
  Machine probe_;
  Eigen::VectorXd x_sizes_, z_sizes_, y_sizes_;  // the largest of each value so far
  double step_ = 0.0;                            // [s] the longest so far
  Eigen::VectorXd up_, down_, near_, wide_;
};

}  // namespace saltus
