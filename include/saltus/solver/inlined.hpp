// Right-hand sides compiled together with the steps of the one-step methods. A step calls the
// type-erased function of a leaf six or twelve times, and each call costs as much as the arithmetic
// of a small right-hand side. Here the step has one indirect call, and the right-hand side has
// none.
#pragma once

#include <array>
#include <utility>

#include "saltus/solver/detail/dop853.hpp"
#include "saltus/solver/detail/dopri5.hpp"
#include "saltus/solver/detail/explicit_step.hpp"
#include "saltus/solver/detail/kernels.hpp"

namespace saltus {

namespace detail {

/// The steps for a right-hand side of type F and N states. They work on local memory, so that the
/// compiler may keep it in registers.
template <int N, class F, Tableau Method>
class InlinedStep {
 public:
  [[gnu::flatten]] static double attempt(const Caller& caller, const Attempt& a,
                                         const StepMemory& memory) {
    InlinedStep own(caller, memory, 1);
    const double error = own.step().attempt(a, own.rate());
    own.give_back(memory, Method::stages);
    std::copy_n(own.x1_.data(), N, memory.x1);
    std::copy_n(own.scratch_.data(), N, memory.scratch);
    return error;
  }
  /// The stages that only the dense output needs.
  [[gnu::flatten]] static void dense(const Caller& caller, double t0, double h,
                                     const StepMemory& memory) {
    InlinedStep own(caller, memory, Method::stages);
    own.step().template stages<Method::stages, Method::rows>(t0, h, own.rate());
    own.give_back(memory, Method::rows);
  }

 private:
  InlinedStep(const Caller& caller, const StepMemory& memory, std::size_t known)
      : function_(*caller.function), leaf_(*caller.leaf), calls_(*caller.calls), at_(*caller.at) {
    std::copy_n(memory.x0, N, x0_.data());
    std::copy_n(memory.k, N * known, k_.data());
  }
  void give_back(const StepMemory& memory, std::size_t made) const {
    std::copy_n(k_.data(), N * made, memory.k);
  }
  ExplicitStep<Method, N, 0> step() {
    return {N, x0_.data(), x1_.data(), scratch_.data(), k_.data()};
  }
  auto rate() {
    return [this](double t, const double* x, double* xdot) {
      ++calls_;
      at_.time = t;
      new (&at_.x) VectorView(x, N);
      VectorFunction::call_as<F>(function_, leaf_, at_, VectorRef(xdot, N));
    };
  }

  const VectorFunction& function_;
  const LeafSystem& leaf_;
  std::int64_t& calls_;
  At at_;
  std::array<double, N> x0_, x1_, scratch_;
  std::array<double, N * Method::rows> k_;
};

template <int N, class F>
inline constexpr StepKernels step_kernels{
    {},
    {&InlinedStep<N, F, Dopri5>::attempt, &InlinedStep<N, F, Dopri5>::dense},
    {&InlinedStep<N, F, Dop853>::attempt, &InlinedStep<N, F, Dop853>::dense}};

}  // namespace detail

/// A right-hand side of N states that the one-step methods may inline:
///     declare_continuous_state(2, inlined<2>(method<&Ball::ode>));
///     declare_continuous_state(2, inlined<2>([](const At& at, VectorRef xdot) { ... }));
/// The results are the same as without `inlined`. A run is faster if this leaf is the only leaf
/// with a continuous state, reads no output of a state as an input, and N is small: about twice as
/// fast for N = 2 (docs/performance.md). The price is the compile time of both methods.
template <int N, class F>
  requires(N > 0)
RightHandSide inlined(F right_hand_side) {
  static_assert(
      !detail::MethodOf<F>::value,
      "a pointer says at run time only which method it is: inlined<N>(method<&Leaf::ode>)");
  return {std::move(right_hand_side), detail::step_kernels<N, F>, N};
}

}  // namespace saltus
