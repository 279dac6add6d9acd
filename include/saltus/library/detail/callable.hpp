// Makes the calculation of an output from a C++ callable over a block's inputs.
#pragma once

#include <array>
#include <concepts>
#include <span>
#include <type_traits>

#include "saltus/base/list.hpp"
#include "saltus/library/detail/arguments.hpp"

namespace saltus::detail {

inline constexpr int most_scalars = 32;  // copied to the stack, so a call allocates nothing

template <class F>
concept OverScalars = std::invocable<const F&, std::span<const double>>;
template <class F>
concept OverInputs = !OverScalars<F> && std::invocable<const F&, const Inputs&>;

template <class F>
struct ResultOf : std::invoke_result<const F&, std::span<const double>> {};
template <OverInputs F>
struct ResultOf<F> : std::invoke_result<const F&, const Inputs&> {};

/// The possible results of a callable: bool, a number, or a vector.
template <class R>
concept Truth = std::same_as<std::remove_cvref_t<R>, bool>;
template <class R>
concept Number = std::convertible_to<R, double>;

template <Number Result>
void store(const std::string&, VectorRef out, const Result& result) {
  out[0] = static_cast<double>(result);
}
template <class Derived>
void store(const std::string& block, VectorRef out, const Eigen::MatrixBase<Derived>& result) {
  insist(result.size() == out.size(), block, "expected ", out.size(),
         " values from its function, found ", result.size(), "; say the width in Options::shape");
  out = result;
}

template <OverInputs F>
VectorFunction calculation(std::string block, F f) {
  return [block = std::move(block), f = std::move(f)](const At& at, VectorRef out) {
    store(block, out, f(at.u));
  };
}
template <OverScalars F>
VectorFunction calculation(std::string block, F f) {
  return [block = std::move(block), f = std::move(f)](const At& at, VectorRef out) {
    std::array<double, most_scalars> scalars{};
    for (int k = 0; k < at.u.size(); ++k) nth(scalars, k) = at.u(k);
    store(block, out,
          f(std::span<const double>(scalars.data(), static_cast<std::size_t>(at.u.size()))));
  };
}

}  // namespace saltus::detail
