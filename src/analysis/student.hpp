// Quantiles of Student's and of the normal distribution.
#pragma once

namespace saltus {

/// The t with P(T <= t) = probability, for T with `freedom` degrees of freedom; infinite freedom is
/// the normal distribution. By bisection of the regularised incomplete beta function, whose continued
/// fraction is DLMF 8.17.22 (W. Lentz, Appl. Opt. 15 (1976) 668).
double student_quantile(double freedom, double probability);

}  // namespace saltus
