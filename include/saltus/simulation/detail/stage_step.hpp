// StageStep: the last step that was taken through the stages of the solver, and S inside of it.
#pragma once

#include <memory>
#include <optional>

#include "saltus/simulation/detail/flow_terms.hpp"
#include "saltus/simulation/detail/integration.hpp"
#include "saltus/simulation/detail/variation.hpp"

namespace saltus {

/// S at both ends of a step, and inside of it by the dense output of the method. All times are in s.
class StageStep {
 public:
  using Flat = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  explicit StageStep(FlowTerms& terms) : terms_(&terms) {}

  /// There is no step, or it does not count any more.
  void forget() { is_there_ = false; }
  bool is_there() const noexcept { return is_there_; }

  /// A step is tried that begins with this S: the method reads `s0` and writes `s1`.
  void begin(const Eigen::MatrixXd& s) { s0_ = s, s1_.resize(s.rows(), s.cols()); }
  const Flat& s0() const noexcept { return s0_; }
  Flat& s1() noexcept { return s1_; }

  /// Who has taken the step, and how.
  struct Taken {
    double from, to;  ///< [s] the columns were carried so far
    double t1, h;     ///< [s] the end and the length of the step of the solver
    Integration* integration;
    ColumnSteps* steps;
  };
  void take(const Taken& step) { taken_ = step, is_ready_ = false, is_there_ = true; }

  double from() const noexcept { return taken_.from; }
  Integration& integration() const noexcept { return *taken_.integration; }
  /// S at a time within the step. False where the solver has its stages no more.
  bool at(double t, Eigen::MatrixXd& s);
  /// The polynomial of the step; none where the solver has its stages no more.
  std::optional<Variation::Piece> piece();

 private:
  bool prepare();
  void read(double t, Eigen::MatrixXd& s);

  FlowTerms* terms_;
  bool is_there_ = false, is_ready_ = false;  // the dense output was made
  Taken taken_ = {};
  Flat s0_, s1_, inside_;  // S at both ends, and at a time inside
};

}  // namespace saltus
