// The losses of a fit, and the covariance of its parameters.
#pragma once

#include <vector>

#include "saltus/analysis/fit.hpp"

namespace saltus {

/// rho(z), rho'(z) and rho''(z).
struct LossValue {
  double value = 0.0, first = 1.0, second = 0.0;
};
LossValue loss_at(Loss loss, double z);

/// Half the sum of f_scale^2 rho((r / f_scale)^2).
double cost_of(const Eigen::VectorXd& residuals, Loss loss, double f_scale);
/// Changes residuals and Jacobian to those of the quadratic model of the cost, J^T J for its Hessian
/// (B. Triggs and others, Bundle Adjustment, LNCS 1883 (2000) 298, section 4.3). Where the loss
/// curves downwards, a part of its slope takes the place of the second derivative.
void weigh(Eigen::VectorXd& residuals, Eigen::MatrixXd& jacobian, Loss loss, double f_scale);

/// The covariance of parameters, infinite and NaN where the data do not determine them.
struct Uncertainty {
  Eigen::MatrixXd covariance;
  /// Sets of parameters of which the data leave a combination open.
  std::vector<std::vector<Index>> undetermined = {};
  bool saddle = false;  ///< no minimum: the second derivatives of the loss are not positive there
};

/// How the covariance is computed.
struct UncertaintyOptions {
  double rtol = 1e-8;  ///< of the derivatives
  Loss loss = Loss::linear;
  double f_scale = 1.0;
  bool absolute = false;
};

/// With the loss linear the covariance is s^2 (J^T J)^-1, s^2 = r^T r / (n - p), or s^2 = 1 with
/// `absolute`. With another loss it is H^-1 B H^-1 n / (n - p), H = J^T diag(rho' + 2 z rho'') J,
/// B = J^T diag(rho'^2 r^2) J, z = (r / f_scale)^2 (P. Huber, 5th Berkeley Symposium 1 (1967) 221). A
/// direction in which the Jacobian, with columns of length 1, has a singular value below `rtol` of the
/// largest is undetermined: its derivatives are known no better.
Uncertainty uncertainty_of(const Eigen::VectorXd& residuals, const Eigen::MatrixXd& jacobian,
                           const UncertaintyOptions& options);

}  // namespace saltus
