// The arguments of the constructors of blocks: numbers or vectors, and the refusal of bad ones.
#pragma once

#include <concepts>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "saltus/base/model_errors.hpp"
#include "saltus/model/leaf_system.hpp"

namespace saltus {

/// A number, a vector or a matrix. A number makes a scalar signal; a vector, even of a single entry,
/// a vector signal. A type of Eigen with one column or one row is a vector, every other one, such as
/// MatrixXd, a matrix.
struct Value {
  Value(double number);                          // NOLINT(google-explicit-constructor)
  Value(std::initializer_list<double> numbers);  // NOLINT(google-explicit-constructor)
  Value(Eigen::VectorXd numbers);                // NOLINT(google-explicit-constructor)
  template <class Derived>
    requires(Derived::IsVectorAtCompileTime != 0)
  Value(const Eigen::MatrixBase<Derived>& numbers)  // NOLINT(google-explicit-constructor)
      : Value(Eigen::VectorXd(numbers)) {}
  template <class Derived>
    requires(Derived::IsVectorAtCompileTime == 0)
  Value(const Eigen::MatrixBase<Derived>& numbers)  // NOLINT(google-explicit-constructor)
      : Value(MatrixByRows(numbers)) {}
  Value(const MatrixByRows& numbers);  // NOLINT(google-explicit-constructor)

  Shape shape() const { return {values.size(), vector, columns}; }

  Eigen::VectorXd values;  ///< of a matrix: row by row
  bool vector = false;     ///< a vector or a matrix
  Index columns = 0;       ///< of a matrix
};

namespace detail {

/// Throws a BlockParameterError for a block; `what` begins with the value found and ends with a remedy.
template <class... Pieces>
void insist(bool good, const std::string& block, const Pieces&... what) {
  if (!good) throw BlockParameterError(text("block '", block, "': ", what...));
}

/// Refuses a word that is not one of the known ones.
void require_known(const std::string& block, std::string_view what, std::string_view word,
                   const std::vector<std::string>& known);

/// Refuses a number of ports below `least`.
void require_count(const std::string& block, std::string_view what, int found, int least);

/// Refuses a period that is not a positive, finite time.
void require_period(const std::string& block, std::string_view what, double found);

}  // namespace detail

}  // namespace saltus
