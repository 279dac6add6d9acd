// RightHandSide: the function of a continuous state, perhaps with steps compiled together with it.
#pragma once

#include <concepts>
#include <utility>

#include "saltus/model/equations.hpp"

namespace saltus {

/// Steps of an integration method that were compiled together with a right-hand side. The solver
/// defines them, and alone knows their contents: see `inlined`.
struct InlinedSteps {};

/// xdot = function(t, x, z, m, u, p).
struct RightHandSide {
  RightHandSide() = default;
  template <class F>
    requires(!std::same_as<F, RightHandSide> && std::constructible_from<VectorFunction, F>)
  RightHandSide(F callable)  // NOLINT(google-explicit-constructor): as a VectorFunction
      : formula(detail::formula_of(callable)),
        function(std::move(callable)),
        states(detail::states_of<F>()) {}
  template <class F>
  RightHandSide(F callable, const InlinedSteps& with, Index number)
      : formula(detail::formula_of(callable)),
        function(std::move(callable)),
        steps(&with),
        states(number) {}

  explicit operator bool() const noexcept { return static_cast<bool>(function); }

  Formula formula = {};  ///< the same as an expression; empty if it is only called
  VectorFunction function = {};
  const InlinedSteps* steps = nullptr;  ///< null: none
  Index states = 0;                     ///< the number of states that it is written for; 0: any
};

}  // namespace saltus
