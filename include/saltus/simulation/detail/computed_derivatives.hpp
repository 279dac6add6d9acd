// ComputedDerivatives: how the parameters that diagrams compute change with those of the diagrams.
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "saltus/model/computed_parameter.hpp"
#include "saltus/simulation/detail/parameter_moves.hpp"

namespace saltus {

/// Multiplies the exact derivatives of the functions of diagrams, from the outer diagrams to the
/// inner ones (the chain rule, forward).
class ComputedDerivatives {
 public:
  /// `computed` is null if no diagram computes a parameter.
  explicit ComputedDerivatives(std::shared_ptr<const ComputedParameters> computed)
      : computed_(std::move(computed)) {
    if (computed_) made_.resize(computed_->all.size());
  }

  /// The derivatives of all parameters p by entry `of`. It has an obstacle where a function has a
  /// kink or a jump, or no finite derivative.
  ParameterDirection by(Index of, const Eigen::VectorXd& p);

 private:
  /// The values of a function, then its derivatives, then its switches.
  struct Partials {
    std::vector<std::pair<Index, Index>> entries;  // value, variable
    Index switches = 0;
    tape::Tape tape;
  };
  const Partials& partials(std::size_t number);
  /// Adds the movement of the values of a function; says why there is none.
  std::string add(std::size_t number, const Eigen::VectorXd& p, Eigen::VectorXd& by);
  bool bends(std::size_t number, const Eigen::VectorXd& p, const Eigen::VectorXd& by);

  std::shared_ptr<const ComputedParameters> computed_;
  std::vector<std::optional<Partials>> made_;  // of each function that was asked for
};

}  // namespace saltus
