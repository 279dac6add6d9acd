// Derivatives: the object through which a leaf writes the derivatives of one of its functions.
#pragma once

#include <Eigen/Core>

#include "saltus/base/view.hpp"

namespace saltus {

/// The partial derivatives of a function of a leaf by all values that it reads, at one `At`. Each block
/// has a row for each number of the function. All begin at zero, so a function writes those that are
/// not:
///     d.by_continuous_state() << 0.0, 1.0, -k, 0.0;
///     d.by_parameter(k_)(1) = -x;
/// The rows of a reset map are x+, then z+.
class Derivatives {
 public:
  /// Over `rows` times `columns(at)` numbers, column after column, which become zero.
  Derivatives(double* values, Index rows, const At& at) : values_(values), rows_(rows), at_(&at) {
    all().setZero();
  }
  /// One for each entry of x, z and p, of each input, and one for the time.
  static Index columns(const At& at) {
    Index sum = at.x.size() + at.z.size() + at.p.size() + 1;
    for (int i = 0; i < at.u.size(); ++i) sum += at.u[i].size();
    return sum;
  }

  MatrixRef by_continuous_state() { return block(0, at_->x.size()); }
  MatrixRef by_discrete_state() { return block(at_->x.size(), at_->z.size()); }
  /// A column for each entry of the parameter.
  MatrixRef by_parameter(ParameterIndex k) {
    return block(at_->x.size() + at_->z.size() + k.offset, k.size);
  }
  /// All parameters, in the order of their declaration.
  MatrixRef by_parameters() { return block(at_->x.size() + at_->z.size(), at_->p.size()); }
  /// A column for each entry of input i.
  MatrixRef by_input(int i) {
    Index first = at_->x.size() + at_->z.size() + at_->p.size();
    for (int k = 0; k < i; ++k) first += at_->u[k].size();
    return block(first, at_->u[i].size());
  }
  /// One column [1/s].
  VectorRef by_time() { return {values_ + rows_ * (columns(*at_) - 1), rows_}; }

  Index rows() const noexcept { return rows_; }
  /// All blocks: x, z, parameters, inputs, time.
  MatrixRef all() { return block(0, columns(*at_)); }
  void setZero() { all().setZero(); }

 private:
  MatrixRef block(Index first, Index width) { return {values_ + rows_ * first, rows_, width}; }

  double* values_;
  Index rows_;
  const At* at_;
};

}  // namespace saltus
