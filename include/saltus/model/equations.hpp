// Equations: a right-hand side written once, for numbers and for expressions.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <utility>
#include <vector>

#include "saltus/model/formula.hpp"

namespace saltus {

namespace detail {

/// The argument of equations: the argument of a formula, with the mode of the block as a number.
template <class Number>
class EquationsAt : public EntryAt<Number> {
 public:
  explicit EquationsAt(const At& at) : EntryAt<Number>(at, 0), mode_(at.mode) {}
  double mode() const { return mode_; }

 private:
  double mode_;
};
template <>
class EquationsAt<tape::Symbol> : public EntryAt<tape::Symbol> {
 public:
  explicit EquationsAt(Symbols& symbols) : EntryAt(symbols, 0) {}
};

/// A right-hand side of N states: see `equations`.
template <int N, class F>
class Equations {
 public:
  explicit Equations(F f) : f_(std::move(f)) {}

  void operator()(const At& at, VectorRef xdot) const { f_(EquationsAt<double>(at), xdot); }

  Formula formula() const {
    return {*this, [f = f_](Symbols& symbols) {
              std::array<tape::Symbol, N> xdot;
              f(EquationsAt<tape::Symbol>(symbols), xdot);
              return std::vector<tape::Symbol>(xdot.begin(), xdot.end());
            }};
  }
  static constexpr Index states = N;

 private:
  F f_;
};

/// The formula of a right-hand side; empty if it has none.
template <class F>
Formula formula_of(const F& right_hand_side) {
  if constexpr (requires {
                  { right_hand_side.formula() } -> std::same_as<Formula>;
                })
    return right_hand_side.formula().called();
  else
    return {};
}

/// The number of states that a right-hand side is written for; 0 if it does not say.
template <class F>
constexpr Index states_of() {
  if constexpr (requires { F::states; })
    return F::states;
  else
    return 0;
}

}  // namespace detail

/// The equations of N states as a function template over the kind of number:
///     .ode = equations<2>([](const auto& at, auto& xdot) {
///       using std::sin;
///       xdot[0] = at.x(1);
///       xdot[1] = -9.8 * sin(at.x(0));
///     })
/// `at` has the members of EntryAt that name an entry, time(), x(j), z(j), u(k, j), p(k, j),
/// relation(r, j), choose(truth, a, b), and mode(). The function runs with numbers, as any other
/// right-hand side, and with symbols, so that its Taylor series and its exact derivatives are
/// known. It must read only `at` and constants, and choose between values by `at.choose` or by a
/// constant. `inlined<N>` takes it too. A block with another number of states refuses it, with a
/// ModelError.
template <int N, class F>
  requires(N > 0)
detail::Equations<N, F> equations(F f) {
  return detail::Equations<N, F>(std::move(f));
}

}  // namespace saltus
