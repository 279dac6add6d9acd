// One type for any callable: `&Block::method` or a lambda. Its type is erased once, at declaration;
// a call costs 3 ns.
#pragma once

#include <cstring>
#include <memory>
#include <type_traits>
#include <utility>

#include "saltus/base/derivatives.hpp"

namespace saltus {

namespace detail {

/// A const method known to the compiler: see `method`.
template <auto M>
struct ConstantMethod {
  static constexpr auto pointer = M;
};
template <class F>
inline constexpr bool is_constant_method = false;
template <auto M>
inline constexpr bool is_constant_method<ConstantMethod<M>> = true;

/// A pointer to a const method of some class derived from LeafSystem.
template <class F>
struct MethodOf : std::false_type {};
template <class R, class C, class... A>
struct MethodOf<R (C::*)(A...) const> : std::true_type {
  using Class = C;
};

/// Calls `f(at, out)`, or stores the number that `f(at)` returns, for a scalar output, guard or
/// derivative.
template <class F>
void call(const F& f, const At& at, const VectorRef& out) {
  if constexpr (std::is_invocable_v<const F&, const At&, VectorRef>) {
    f(at, out);
  } else {
    // The view is const, but its memory is not.
    *const_cast<double*>(out.data()) = static_cast<double>(f(at));
  }
}
template <class F>
void call(const F& f, const At& at, const MatrixRef& out) {
  f(at, out);
}
template <class F>
void call(const F& f, const At& at, Next& next) {
  f(at, next);
}
template <class F>
void call(const F& f, const At& at, Derivatives& out) {
  f(at, out);
}
template <class F>
void call(const F& f, const At& at, Delivery& next) {
  f(at, next);
}

}  // namespace detail

/// `method<&Ball::ode>` in place of `&Ball::ode` is the same callback, but it is called directly
/// and not through a pointer, so the compiler can inline it.
template <auto M>
  requires(detail::MethodOf<decltype(M)>::value)
inline constexpr detail::ConstantMethod<M> method{};

template <class Signature>
class Callback;

/// A function of a leaf: a const method of the leaf, or any callable that does not need the leaf.
/// The leaf is passed at each call, so it may be moved after its callbacks were declared.
template <class Out>
class Callback<void(const At&, Out)> {
  // Users get views by value; on the way to them views are passed by reference.
  using Passed = std::add_lvalue_reference_t<const Out>;

 public:
  Callback() = default;

  template <class F>
    requires(!std::is_same_v<std::remove_cvref_t<F>, Callback>)
  Callback(F function) {  // NOLINT(google-explicit-constructor): declarations read as names
    if constexpr (detail::MethodOf<F>::value) {
      static_assert(sizeof(F) <= sizeof(method_));
      std::memcpy(method_, &function, sizeof(F));
      call_ = &Callback::call_method<F>;
    } else {
      if constexpr (!detail::is_constant_method<F>)
        callable_ = std::make_shared<const F>(std::move(function));
      call_ = &Callback::call_as<F>;
    }
  }

  explicit operator bool() const noexcept { return call_ != nullptr; }
  void operator()(const LeafSystem& leaf, const At& at, Passed out) const {
    call_(*this, leaf, at, out);
  }

  /// The callable, if this object was made from an F that is not a pointer to a method; otherwise
  /// null.
  template <class F>
  const F* target() const noexcept {
    return call_ == &Callback::call_as<F> ? static_cast<const F*>(callable_.get()) : nullptr;
  }

  /// The same call, for a caller that knows that `self` was made from an F that is not a pointer to
  /// a method.
  template <class F>
  [[gnu::always_inline]] static void call_as(const Callback& self, const LeafSystem& leaf,
                                             const At& at, Passed out) {
    if constexpr (detail::is_constant_method<F>)
      call_bound(F::pointer, leaf, at, out);
    else
      detail::call<F>(*static_cast<const F*>(self.callable_.get()), at, out);
  }

 private:
  template <class F>
  static void call_method(const Callback& self, const LeafSystem& leaf, const At& at, Passed out) {
    F method;
    std::memcpy(&method, self.method_, sizeof(F));
    call_bound(method, leaf, at, out);
  }

  template <class M>
  [[gnu::always_inline]] static void call_bound(M method, const LeafSystem& leaf, const At& at,
                                                Passed out) {
    const auto& block = static_cast<const typename detail::MethodOf<M>::Class&>(leaf);
    const auto bound = [&block, method](auto&&... arguments)
        -> decltype((block.*method)(std::forward<decltype(arguments)>(arguments)...)) {
      return (block.*method)(std::forward<decltype(arguments)>(arguments)...);
    };
    detail::call<decltype(bound)>(bound, at, out);
  }

  void (*call_)(const Callback&, const LeafSystem&, const At&, Passed) = nullptr;
  alignas(void*) unsigned char method_[2 * sizeof(void*)] = {};
  std::shared_ptr<const void> callable_;
};

/// Fills a vector: a derivative, an output, a guard. A function that returns a number fills one
/// entry.
using VectorFunction = Callback<void(const At&, VectorRef)>;

/// A reset map or update: it sets the new state through `Next`.
using ResetMap = Callback<void(const At&, Next&)>;

/// The reset map of an event input: `Delivery` has the weight of the wire, too.
using DeliveryMap = Callback<void(const At&, Delivery&)>;

/// Fills a matrix, for example the Jacobian d(xdot)/d(x).
using MatrixFunction = Callback<void(const At&, MatrixRef)>;

/// Writes the derivatives of another function by all that it reads.
using DerivativesFunction = Callback<void(const At&, Derivatives&)>;

}  // namespace saltus
