// NumberOf: a number, or a function of the values of a leaf that gives one.
#pragma once

#include <type_traits>
#include <utility>

#include "saltus/base/callback.hpp"

namespace saltus {

/// A constant, or a function f(t, x, z, m, u, p) of a leaf with one number as its value.
class NumberOf {
 public:
  template <class F>
    requires(!std::is_same_v<std::remove_cvref_t<F>, NumberOf>)
  NumberOf(F given) {  // NOLINT(google-explicit-constructor): declarations read as names
    if constexpr (std::is_arithmetic_v<F>)
      constant_ = static_cast<double>(given);
    else
      function_ = VectorFunction(std::move(given));
  }

  bool is_constant() const noexcept { return !function_; }
  double constant() const noexcept { return constant_; }  ///< if it is a constant
  const VectorFunction& function() const noexcept { return function_; }

  double operator()(const LeafSystem& leaf, const At& at) const {
    double value = constant_;
    if (function_) function_(leaf, at, VectorRef(&value, 1));
    return value;
  }

 private:
  double constant_ = 0.0;
  VectorFunction function_ = {};
};

}  // namespace saltus
