// TangentGaps: the derivatives that do not exist, and the reasons.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "saltus/simulation/detail/one_sided.hpp"
#include "saltus/simulation/detail/tangent_flow.hpp"
#include "saltus/simulation/results.hpp"

namespace saltus {

/// The entries of the state, and the columns, that have one-sided derivatives at a jump of the flow. It
/// is empty where there is no jump.
using AtJump = OneSided::Mask;

/// Sets columns to NaN and writes `Sensitivities::gaps`. All times are in s.
class TangentGaps {
 public:
  /// In place of a derivative that does not exist.
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();

  TangentGaps(TangentColumns& columns, Results& results) : columns_(&columns), results_(&results) {}

  /// A run with the parameters of the results begins.
  void begin() { lost_.assign(results_->sensitivities.size(), 0); }

  /// Nothing has a derivative by parameter k from the event at t on. The first reason counts.
  void lose(double t, Index k, const std::string& event, const std::string& reason);
  /// As `lose`, for each column with a number that is not finite: no column becomes NaN in silence.
  /// The obstacle, if there is one, is the reason.
  void lose_not_finite(double t, const std::string& obstacle);
  bool lost(Index k) const { return nth(lost_, k) != 0; }

  /// Something at t has no derivative by parameter k. The column does not change.
  void note(double t, Index k, const std::string& event, const std::string& reason);
  /// Takes the derivatives away that are one-sided at t.
  void clear(const OneSided& one_sided, double t, const std::string& reason, Eigen::MatrixXd& x,
             Eigen::MatrixXd& z);

  /// The same at a jump of the flow.
  void clear(const AtJump& jump, double t, const std::string& reason, Eigen::MatrixXd& x);

  /// As `clear`, for a run that ends at t.
  void end(const OneSided& one_sided, const AtJump& jump, double t, Eigen::MatrixXd& x,
           Eigen::MatrixXd& z);
  /// A run that goes on does not end there.
  void forget_end();

 private:
  TangentColumns* columns_;
  Results* results_;
  std::vector<char> lost_;        // of each parameter
  bool ends_at_instant_ = false;  // the gaps may contain the end of the run
};

}  // namespace saltus
