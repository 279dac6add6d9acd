// The derivatives of all recorded signals at one state.
#pragma once

#include "saltus/simulation/detail/tangent_probe.hpp"

namespace saltus {

/// A row for each entry of each tap, a column for each parameter: by differences, at a fixed time.
/// The rows of views of states are not computed; `put_views` has them.
Eigen::MatrixXd signal_tangents(TangentProbe& probe, const Plan& plan, double t, const double* x,
                                const TangentColumns& at);
/// Writes the rows that are entries of the state: they need no differences.
void put_views(const Plan& plan, const Eigen::MatrixXd& by_x, const Eigen::MatrixXd& by_z,
               Eigen::MatrixXd& all);

}  // namespace saltus
