// Searches of a fit, from one start after the other.
#pragma once

#include "fit_result.hpp"

namespace saltus {

/// The best of all starts, a converged one if there is any; the best point so far if the option
/// interrupt ends it. Throws SimulationError if no start has residuals.
FitEnded search_fit(FitProblem& problem, const std::vector<Eigen::VectorXd>& starts,
                    const FitOptions& options);

}  // namespace saltus
