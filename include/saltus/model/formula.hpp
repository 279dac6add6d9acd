// Formula: the computation of a block, entry by entry, as a call and as an expression to be fused.
#pragma once

#include <functional>
#include <type_traits>
#include <utility>
#include <vector>

#include "saltus/base/callback.hpp"
#include "saltus/base/pack.hpp"
#include "saltus/tape/symbol.hpp"

namespace saltus {

namespace detail {

/// The symbols of one block, made by the pass that records its formula as a graph.
class Symbols {
 public:
  virtual ~Symbols() = default;
  virtual tape::Symbol time() = 0;
  virtual tape::Symbol state(Index i) = 0;
  virtual tape::Symbol discrete_state(Index i) = 0;
  virtual tape::Symbol mode() = 0;
  virtual tape::Symbol parameter(Index i) = 0;
  virtual tape::Symbol input(int k, Index i) = 0;
  virtual Index width(int k) = 0;
  virtual Index columns(int k) = 0;
  virtual tape::Symbol relation(RelationIndex r, Index i) = 0;
};

}  // namespace detail

/// The argument of a formula that computes one entry of an output, a derivative or a guard, "the
/// entry". Its values are numbers (`Number` is double, or Pack for several entries at once) or
/// symbols for them. Both versions have the same members.
template <class Number>
class EntryAt {
 public:
  EntryAt(const At& at, Index i) : at_(at), i_(i) {}

  double time() const { return at_.time; }              ///< [s]
  Number x() const { return read(at_.x.data() + i_); }  ///< the entry of the continuous state
  double x(Index j) const { return at_.x[j]; }          ///< entry j of the continuous state
  double z(Index j) const { return at_.z[j]; }          ///< entry j of the discrete state
  /// The entry of input k; a scalar input has only one. With j: entry j.
  Number u(int k) const { return entry(at_.u[k]); }
  double u(int k, Index j) const { return at_.u[k][j]; }
  Index width(int k) const { return at_.u[k].size(); }  ///< of input k
  /// Of input k, if it is a matrix; otherwise 0.
  Index columns(int k) const { return at_.u.columns(k); }
  /// The entry of a parameter; a scalar has only one. With j: entry j.
  Number p(ParameterIndex k) const { return entry(at_.parameter(k)); }
  double p(ParameterIndex k, Index j) const { return at_.parameter(k)[j]; }
  /// The truth of the entry of a relation, as `At::relation` gives it. With j: the truth of entry
  /// j.
  Number relation(RelationIndex r) const { return read(at_.relation_values(r) + i_); }
  bool relation(RelationIndex r, Index j) const { return at_.relation(r, j); }
  /// Returns `a` if `truth` is not 0, otherwise `b`; both are computed.
  Number choose(const Number& truth, const Number& a, const Number& b) const {
    if constexpr (std::is_same_v<Number, Pack>) {
      return Pack::choose(truth, a, b);
    } else {
      return truth != 0.0 ? a : b;
    }
  }

 private:
  static Number read(const double* first) {
    if constexpr (std::is_same_v<Number, Pack>) {
      return Pack(first);
    } else {
      return *first;
    }
  }
  Number entry(const VectorView& values) const {
    return values.size() == 1 ? Number(*values.data()) : read(values.data() + i_);
  }
  const At& at_;
  Index i_;
};

template <>
class EntryAt<tape::Symbol> {
  using Symbol = tape::Symbol;

 public:
  EntryAt(detail::Symbols& symbols, Index i) : symbols_(symbols), i_(i) {}

  Symbol time() const { return symbols_.time(); }
  Symbol x() const { return x(i_); }
  Symbol x(Index j) const { return symbols_.state(j); }
  Symbol z(Index j) const { return symbols_.discrete_state(j); }
  Symbol mode() const { return symbols_.mode(); }
  Symbol u(int k) const { return u(k, width(k) == 1 ? 0 : i_); }
  Symbol u(int k, Index j) const { return symbols_.input(k, j); }
  Index width(int k) const { return symbols_.width(k); }
  Index columns(int k) const { return symbols_.columns(k); }
  Symbol p(ParameterIndex k) const { return p(k, k.size == 1 ? 0 : i_); }
  Symbol p(ParameterIndex k, Index j) const { return symbols_.parameter(k.offset + j); }
  Symbol relation(RelationIndex r) const { return relation(r, i_); }
  Symbol relation(RelationIndex r, Index j) const { return symbols_.relation(r, j); }
  Symbol choose(const Symbol& truth, const Symbol& a, const Symbol& b) const {
    return Symbol::apply(tape::Op::select, {truth, a, b});
  }

 private:
  detail::Symbols& symbols_;
  Index i_;
};

/// A function template that computes one entry of an output, a derivative or a guard. It looks like
/// `[](const auto& at) { return at.u(0) * at.u(1); }` if all entries are alike, where `at` is an
/// EntryAt; otherwise like `[](const auto& at, Index i) { ... }` with the index of the entry. A
/// block that runs alone calls it with numbers. A plan calls it with symbols, and computes the
/// formulas of blocks that feed one another together, to the same bits. So the function must read
/// only `at` and constants, and must choose between values by `at.choose` or by a constant.
class Formula {
 public:
  Formula() = default;
  template <class F>
    requires std::is_invocable_v<const F&, const EntryAt<double>&>
  Formula(F f)  // NOLINT(google-explicit-constructor): declarations read as names
      : function_([f](const At& at, VectorRef out) {
          Index i = 0;
          for (; i + Pack::size <= out.size(); i += Pack::size)
            Pack(f(EntryAt<Pack>(at, i))).store(&out[i]);
          for (; i < out.size(); ++i) out[i] = f(EntryAt<double>(at, i));
        }),
        symbol_([f](detail::Symbols& symbols, Index i) -> tape::Symbol {
          return f(EntryAt<tape::Symbol>(symbols, i));
        }) {}
  template <class F>
    requires std::is_invocable_v<const F&, const EntryAt<double>&, Index>
  Formula(F f)  // NOLINT(google-explicit-constructor): declarations read as names
      : function_([f](const At& at, VectorRef out) {
          for (Index i = 0; i < out.size(); ++i) out[i] = f(EntryAt<double>(at, i), i);
        }),
        symbol_([f](detail::Symbols& symbols, Index i) -> tape::Symbol {
          return f(EntryAt<tape::Symbol>(symbols, i), i);
        }) {}

  /// Makes a formula of a function that computes all entries, and of their expressions.
  Formula(VectorFunction function, std::function<std::vector<tape::Symbol>(detail::Symbols&)> all)
      : function_(std::move(function)), all_(std::move(all)) {}

  explicit operator bool() const noexcept { return static_cast<bool>(function_); }
  /// The same formula, but its block calls its function: a plan does not join it with others. It is
  /// read only as an expression, for example for its Taylor series.
  Formula called() const {
    Formula same = *this;
    same.joins_ = false;
    return same;
  }
  /// Whether a plan may compute it together with the formulas that it reads and that read it.
  bool joins() const noexcept { return joins_; }
  /// Computes all entries, by calls with numbers.
  const VectorFunction& function() const noexcept { return function_; }
  /// `size` entries, as expressions of these symbols.
  std::vector<tape::Symbol> symbols(detail::Symbols& of, Index size) const {
    if (all_) return all_(of);
    std::vector<tape::Symbol> entries;
    for (Index i = 0; i < size; ++i) entries.push_back(symbol_(of, i));
    return entries;
  }

 private:
  VectorFunction function_ = {};
  std::function<tape::Symbol(detail::Symbols&, Index)> symbol_ = {};
  std::function<std::vector<tape::Symbol>(detail::Symbols&)> all_ = {};  // in place of symbol_
  bool joins_ = true;
};

}  // namespace saltus
