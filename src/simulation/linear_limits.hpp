// LinearLimits: where a system has no linearisation, and why.
#pragma once

#include <functional>

#include "saltus/simulation/detail/chain_rule.hpp"
#include "saltus/simulation/detail/standstill.hpp"
#include "saltus/simulation/linearize.hpp"

namespace saltus {

/// Throws ModelError where the flow beside the present state is not the one at it.
class LinearLimits {
 public:
  LinearLimits(Standstill& at, ChainRule& rule) : at_(at), rule_(rule) {}

  /// No block is at rest.
  void require_motion() const;
  /// No function has a kink, or a derivative that is not finite.
  void require_smooth() const;
  void require_finite(const Linearization& found) const;
  /// No guard with an effect is at zero.
  void require_guards_off_zero() const;
  /// No relation is at its root, unless both sides are the same. `matrices` shows what the rule
  /// computed last; `found` is that of the present side.
  void require_relations_off_roots(const std::function<Linearization()>& matrices,
                                   const Linearization& found) const;

 private:
  const Plan& plan() const { return at_.machine().plan(); }
  [[noreturn]] void refuse(const std::string& what) const;
  double error_of(const ChainRule::Level& level, Index i) const;
  void require_off_zero(const GuardGroup& group) const;
  bool at_root(int node, Index entry) const;

  Standstill& at_;
  ChainRule& rule_;
};

}  // namespace saltus
