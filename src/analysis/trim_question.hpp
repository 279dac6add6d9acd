// The arguments of trim, checked, and their names found.
#pragma once

#include "trim_search.hpp"

namespace saltus {

struct TrimQuestion {
  std::string where;
  TrimProblem problem;
  TrimBounds bounds;
  Eigen::VectorXd start;
  double tolerance = 1e-9;
  std::optional<int> max_nfev;

  /// The operating point that the search finds from a start.
  OperatingPoint answer(const Eigen::VectorXd& from);
};

/// Throws ModelError as `trim` does. `where` begins the messages.
TrimQuestion trim_question(const std::string& where, const System& system, const Context& context,
                           const TrimOptions& options);

}  // namespace saltus
