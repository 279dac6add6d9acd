// Formula: what a block computes, entry by entry, as a call and as an expression to be fused.
#pragma once

#include <functional>
#include <type_traits>
#include <utility>

#include "saltus/base/callback.hpp"
#include "saltus/tape/symbol.hpp"

namespace saltus {

namespace detail {

/// Where the symbols of one block come from: whoever writes its formula down as a graph.
class Symbols {
 public:
  virtual ~Symbols() = default;
  virtual tape::Symbol time() = 0;
  virtual tape::Symbol state(Index i) = 0;
  virtual tape::Symbol parameter(Index i) = 0;
  virtual tape::Symbol input(int k, Index i) = 0;
  virtual Index width(int k) = 0;
  virtual tape::Symbol relation(RelationIndex r, Index i) = 0;
};

}  // namespace detail

/// What a formula sees where it gives entry `index()`: numbers (`Number` is double), or symbols
/// that stand for them. Both have the same members.
template <class Number>
class EntryAt;

template <>
class EntryAt<double> {
 public:
  EntryAt(const At& at, Index i) : at_(at), i_(i) {}

  Index index() const { return i_; }            ///< of the output, derivative or guard
  double time() const { return at_.time; }      ///< [s]
  double x(Index j) const { return at_.x[j]; }  ///< entry j of the continuous state of the block
  /// The entry of input k at `index()`, of a scalar the only one; or entry j.
  double u(int k) const { return entry(at_.u[k]); }
  double u(int k, Index j) const { return at_.u[k][j]; }
  Index width(int k) const { return at_.u[k].size(); }  ///< of input k
  /// The entry of a parameter at `index()`, of a scalar the only one; or entry j.
  double p(ParameterIndex k) const { return entry(at_.parameter(k)); }
  double p(ParameterIndex k, Index j) const { return at_.parameter(k)[j]; }
  /// The truth of a relation, its entry `index()` or j, as `At::relation`.
  bool relation(RelationIndex r) const { return at_.relation(r, i_); }
  bool relation(RelationIndex r, Index j) const { return at_.relation(r, j); }
  /// `a` if `truth`, else `b`; both are computed.
  double choose(bool truth, double a, double b) const { return truth ? a : b; }

 private:
  double entry(const VectorView& values) const { return values[values.size() == 1 ? 0 : i_]; }
  const At& at_;
  Index i_;
};

template <>
class EntryAt<tape::Symbol> {
 public:
  EntryAt(detail::Symbols& symbols, Index i) : symbols_(symbols), i_(i) {}

  Index index() const { return i_; }
  tape::Symbol time() const { return symbols_.time(); }
  tape::Symbol x(Index j) const { return symbols_.state(j); }
  tape::Symbol u(int k) const { return symbols_.input(k, width(k) == 1 ? 0 : i_); }
  tape::Symbol u(int k, Index j) const { return symbols_.input(k, j); }
  Index width(int k) const { return symbols_.width(k); }
  tape::Symbol p(ParameterIndex k) const { return p(k, k.size == 1 ? 0 : i_); }
  tape::Symbol p(ParameterIndex k, Index j) const { return symbols_.parameter(k.offset + j); }
  tape::Symbol relation(RelationIndex r) const { return symbols_.relation(r, i_); }
  tape::Symbol relation(RelationIndex r, Index j) const { return symbols_.relation(r, j); }
  tape::Symbol choose(const tape::Symbol& truth, const tape::Symbol& a,
                      const tape::Symbol& b) const {
    return tape::Symbol::apply(tape::Op::select, {truth, a, b});
  }

 private:
  detail::Symbols& symbols_;
  Index i_;
};

/// One function template `f(at)`, `at` an EntryAt, that gives one entry of an output, a derivative
/// or a guard: `[](const auto& at) { return at.u(0) * at.u(1); }`. It is called with numbers where
/// the block stands alone; a plan calls it with symbols, and computes the formulas of blocks that
/// feed one another in one go, to the same bits. So it must read nothing but `at` and what never
/// changes, and may decide by `at.choose` and by what never changes only.
class Formula {
 public:
  Formula() = default;
  template <class F>
    requires(std::is_invocable_v<const F&, const EntryAt<double>&> &&
             std::is_invocable_v<const F&, const EntryAt<tape::Symbol>&>)
  Formula(F f)  // NOLINT(google-explicit-constructor): declarations read as names
      : function_([f](const At& at, VectorRef out) {
          for (Index i = 0; i < out.size(); ++i) {
            out[i] = static_cast<double>(f(EntryAt<double>(at, i)));
          }
        }),
        symbol_([f](detail::Symbols& symbols, Index i) {
          return tape::Symbol(f(EntryAt<tape::Symbol>(symbols, i)));
        }) {}

  explicit operator bool() const noexcept { return static_cast<bool>(function_); }
  /// All entries, by calls with numbers.
  const VectorFunction& function() const noexcept { return function_; }
  /// Entry i, as an expression of these symbols.
  tape::Symbol symbol(detail::Symbols& symbols, Index i) const { return symbol_(symbols, i); }

 private:
  VectorFunction function_ = {};
  std::function<tape::Symbol(detail::Symbols&, Index)> symbol_ = {};
};

}  // namespace saltus
