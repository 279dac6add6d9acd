// y = (b_0 s^m + ... + b_m) / (a_0 s^n + ... + a_n) u, with m <= n.
#include "saltus/library/transfer_function.hpp"

#include "saltus/library/detail/realisation.hpp"

namespace saltus {

namespace {

using Start = TransferFunctionOptions;

/// z at the start. In a steady state only v itself is not 0: y = b_m v.
Eigen::VectorXd initial_companion(const std::string& block, const detail::Polynomials& p,
                                  const Start& start) {
  const Index n = p.order();
  detail::insist(!start.initial_state || !start.initial_output, block,
                 "initial_state and initial_output are both given; give one of them");
  if (start.initial_state) {
    const Index found = start.initial_state->size();
    detail::insist(found == n, block, "initial_state has ", found, " values; expected ", n,
                   ", the degree of the denominator");
    return *start.initial_state;
  }
  Eigen::VectorXd z = Eigen::VectorXd::Zero(n);
  if (!start.initial_output || n == 0) return z;
  const double a = p.denominator[n], b = p.numerator[p.numerator.size() - 1];
  detail::insist(a != 0.0 && b != 0.0, block,
                 "initial_output needs a gain at s = 0 that is finite and not 0, found ", b, " / ",
                 a, "; give initial_state");
  // With b_0 != 0 the output is (b_n - b_0 a_n / a_0) v + (b_0 / a_0) u, and u = a_n v / a_0.
  z[0] = *start.initial_output * p.denominator[0] / b;
  return z;
}

}  // namespace

TransferFunction::TransferFunction(std::string name, const Eigen::VectorXd& numerator,
                                   const Eigen::VectorXd& denominator, const Options& options)
    : LeafSystem(std::move(name)) {
  const auto p = detail::proper(this->name(), "s", numerator, denominator);
  const Eigen::VectorXd z = initial_companion(this->name(), p, options);
  const Index n = p.order(), padding = p.denominator.size() - p.numerator.size();
  const ParameterIndex b = declare_dynamic_parameter("numerator", p.numerator);
  const ParameterIndex a = declare_dynamic_parameter("denominator", p.denominator);
  scales_ = detail::balance(p);
  declare_input_port({.name = "in", .shape = Shape::scalar()});
  if (n > 0) {
    declare_continuous_state({.initial = z.cwiseQuotient(scales_),
                              .reads = Reads::continuous_state | Reads::inputs,
                              .formula = [=, scales = scales_](const auto& at, Index i) {
                                if (i + 1 < n) return scales[i + 1] / scales[i] * at.x(i + 1);
                                auto last = at.u(0, 0) / scales[i];
                                for (Index j = 0; j < n; ++j)
                                  last -= scales[j] / scales[i] * (at.p(a, n - j) / at.p(a, 0)) *
                                          at.x(j);
                                return last;
                              }});
  }
  const bool through = p.feedthrough();
  declare_output_port(
      {.name = "out",
       .reads = through ? Reads::continuous_state | Reads::inputs : Reads::continuous_state,
       .inputs = through ? std::vector{0} : std::vector<int>{},
       .formula = [=, scales = scales_](const auto& at, Index) {
         const auto gain = at.p(b, 0) / at.p(a, 0);
         const auto term = [&](Index j) {  // of s^j; with a feedthrough less its part
           auto c = at.p(b, n - j - padding) / at.p(a, 0);
           if (through) c -= gain * (at.p(a, n - j) / at.p(a, 0));
           return scales[j] * c * at.x(j);
         };
         if (n == 0) return gain * at.u(0, 0);
         auto y = term(0);
         for (Index j = 1; j <= n - padding && j < n; ++j) y += term(j);
         return through ? y + gain * at.u(0, 0) : y;
       }});
}

}  // namespace saltus
