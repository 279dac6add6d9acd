// The arguments of the constructors of blocks, and the refusal of bad ones.
#include "saltus/library/detail/arguments.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace saltus {

Value::Value(double number) : values(Eigen::VectorXd::Constant(1, number)) {}

Value::Value(std::initializer_list<double> numbers)
    : Value(Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(
          numbers.begin(), static_cast<Index>(numbers.size())))) {}

Value::Value(Eigen::VectorXd numbers) : values(std::move(numbers)), vector(true) {}

Value::Value(const MatrixByRows& numbers)
    : values(Eigen::Map<const Eigen::VectorXd>(numbers.data(), numbers.size())),
      vector(true),
      columns(numbers.cols()) {}

namespace detail {

void require_known(const std::string& block, std::string_view what, std::string_view word,
                   const std::vector<std::string>& known) {
  const bool found = std::ranges::find(known, word) != known.end();
  insist(found, block, "unknown ", what, " '", word, "'", known_names(word, known));
}

void require_count(const std::string& block, std::string_view what, int found, int least) {
  insist(found >= least, block, "expected ", least, " ", what, " or more, found ", found);
}

void require_period(const std::string& block, std::string_view what, double found) {
  insist(found > 0.0 && std::isfinite(found), block, what, " = ", found,
         " s; expected a finite time > 0 s");
}

}  // namespace detail

}  // namespace saltus
