// The arguments of the constructors of blocks: numbers or vectors, and the refusal of bad ones.
#pragma once

#include <concepts>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "saltus/model/leaf_system.hpp"

namespace saltus {

/// A number or a vector. A number makes a scalar signal; a vector, even of a single entry, makes a
/// vector signal.
struct Value {
  Value(double number)
      : values(Eigen::VectorXd::Constant(1, number)) {}  // NOLINT(google-explicit-constructor)
  Value(std::initializer_list<double> numbers)           // NOLINT(google-explicit-constructor)
      : values(
            Eigen::Map<const Eigen::VectorXd>(numbers.begin(), static_cast<Index>(numbers.size()))),
        vector(true) {}
  template <class Derived>
  Value(const Eigen::MatrixBase<Derived>& numbers)
      : values(numbers), vector(true) {}  // NOLINT(google-explicit-constructor)

  Shape shape() const { return {values.size(), vector}; }

  Eigen::VectorXd values;
  bool vector = false;
};

namespace detail {

/// Throws a ModelError for a block; `what` begins with the value found and ends with a remedy.
template <class... Pieces>
void insist(bool good, const std::string& block, const Pieces&... what) {
  if (!good) throw ModelError(text("block '", block, "': ", what...));
}

/// Refuses a word that is not one of the known ones.
inline void require_known(const std::string& block, std::string_view what, std::string_view word,
                          const std::vector<std::string>& known) {
  const bool found = std::ranges::find(known, word) != known.end();
  insist(found, block, "unknown ", what, " '", word, "'", known_names(word, known));
}

/// Refuses a number of ports below `least`.
inline void require_count(const std::string& block, std::string_view what, int found, int least) {
  insist(found >= least, block, "expected ", least, " ", what, " or more, found ", found);
}

/// Refuses a period that is not a positive, finite time.
inline void require_period(const std::string& block, std::string_view what, double found) {
  insist(found > 0.0 && std::isfinite(found), block, what, " = ", found,
         " s; expected a finite time > 0 s");
}

}  // namespace detail

}  // namespace saltus
