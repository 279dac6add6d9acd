// The last step that was carried through stages, and S inside of it.
#include "saltus/simulation/detail/stage_step.hpp"

#include <vector>

namespace saltus {

/// An instant may change what the flow reads, so the dense output is made before.
bool StageStep::prepare() {
  if (is_ready_) return true;
  Eigen::VectorXd x(s0_.rows());
  // The solver makes its dense output.
  taken_.integration->interpolate(taken_.from + 0.5 * taken_.h, x.data());
  const StepStages step = taken_.integration->stages();
  if (!step || step.t0 != taken_.from || !step.dense) return false;
  taken_.steps->prepare_dense(step, *terms_, s0_.data(), s1_.data());
  inside_.resize(s0_.rows(), s0_.cols());
  return is_ready_ = true;
}

void StageStep::read(double t, Eigen::MatrixXd& s) {
  if (t == taken_.t1) return s = s1_, void();
  taken_.steps->read((t - taken_.from) / taken_.h, s0_.data(), inside_.data());
  s = inside_;
}

bool StageStep::at(double t, Eigen::MatrixXd& s) {
  if (!(taken_.from <= t && t <= taken_.to) || !prepare()) return false;
  read(t, s);
  return true;
}

std::optional<Variation::Piece> StageStep::piece() {
  if (!prepare()) return {};
  const std::size_t count = taken_.steps->degree() < static_cast<int>(Variation::few_nodes)
                                ? Variation::few_nodes
                                : Variation::most_nodes;
  Variation::Piece piece{taken_.from, taken_.to, {}};
  for (const double node : Variation::nodes_of(count))
    read(node == 1.0 ? taken_.to : taken_.from + node * (taken_.to - taken_.from),
         piece.s.emplace_back());
  return piece;
}

}  // namespace saltus
