// Kinks of the flow at which the state rests.
#include "saltus/simulation/detail/resting_kinks.hpp"

namespace saltus {

namespace {

/// A parameter may move a state behind so many integrators.
constexpr int derivatives_ahead = 4;

}  // namespace

void RestingKinks::look(double t, const TangentColumns& columns, TangentGaps& gaps) {
  const double* x = machine_->x.data();
  if (!flow_->rests_at_switch(t, x, probe_->flow(t, x))) return;
  Eigen::MatrixXd a, b;
  flow_->at(t, x, columns, a, b);
  for (Index k = 0; k < columns.size(); ++k)
    if (!gaps.lost(k) && bends_soon(t, columns, k, a, b))
      gaps.lose(t, k, "", "the flow has a kink, at which the state rests");
}

/// Whether a column leads off the kink, now or as the derivatives of S = A S + b lead it on.
bool RestingKinks::bends_soon(double t, const TangentColumns& columns, Index k,
                              const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  const double* x = machine_->x.data();
  TangentDirection along = columns.column(k);
  along.t = 0.0;
  if (flow_->bends(t, x, along)) return true;
  Eigen::VectorXd later = a * columns.x.col(k) + b.col(k);
  for (int i = 0; i < derivatives_ahead && !later.isZero(0.0); ++i) {
    if (flow_->bends(t, x, {.x = later.data()})) return true;
    later = a * later;
  }
  return false;
}

}  // namespace saltus
