// Crowd locator: the crossings of many monitors in one interval, from a few looks at all guards.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "saltus/solver/detail/glance.hpp"
#include "saltus/solver/detail/guard_polynomials.hpp"
#include "saltus/solver/detail/search_thresholds.hpp"
#include "saltus/solver/detail/thresholds.hpp"

namespace saltus {

/// Monitors stop nothing, so they need not be located one after the other: n of them cost as many
/// looks as one. The polynomials of all guards are read for the crossings, the looks beyond zero
/// and the dips that single looks would find.
class CrowdLocator : protected Glance {
 protected:
  using Glance::Glance;

  /// How the crossings of many monitors in (from, to] were located.
  enum class Crowd {
    located,   ///< from a few looks for all of them
    too_wide,  ///< not at all: a shorter interval is needed
    mixed      ///< not at all: a guard is no monitor, or no smooth function of time
  };

  /// Locates the crossings of many monitors together. crossed_ and high_ are those at `to`.
  template <class Interpolate>
  Crowd locate_crowd(double from, double to, const Interpolate& interpolate) {
    const auto is_plain = [&](std::size_t k) {
      const Guard& guard = (*guards_)[k];
      return guard.monitor && !guard.jumps && guard.plain_side() != 0.0 && std::isfinite(high_[k]);
    };
    const double resolution = thresholds::eps * (std::abs(t0_) + to);
    if (to - from < thresholds::crowd_roundings * resolution ||
        !std::ranges::all_of(crossed_, is_plain))
      return Crowd::mixed;
    polynomials_.begin(from, to, guards_->g, high_);
    for (int j = 1; j < GuardPolynomials::degree; ++j)
      look(polynomials_.point(j), nullptr, interpolate, polynomials_.values(j));
    const Crowd crowd = find_crowd(to - from);
    if (crowd == Crowd::located) {
      note_crowd();
      shift(from), may_go_back_ = false;
      follow();
    }
    return crowd;
  }

 private:
  struct Member {
    double u;
    std::size_t slot;
    double error;  // of its value at u
  };

  /// Finds the crossing of each guard of a crowd in its polynomial.
  Crowd find_crowd(double length) {
    crowd_.clear();
    Crowd crowd = Crowd::located;
    auto crossed = crossed_.begin();  // in the order of the active guards
    for (std::size_t i = 0; i < located_->slots.size(); ++i) {
      const std::size_t k = located_->slots[i];
      const Guard& guard = (*guards_)[k];
      const bool crosses = crossed != crossed_.end() && *crossed == k;
      crossed += crosses;
      const int first = first_fired(i);
      const bool once =
          crosses == (first <= GuardPolynomials::degree) && stays_fired(i, first) &&
          (guard.plain_side() == 0.0 || !polynomials_.may_dip(k, guard.plain_side(), first));
      if (once && !crosses) continue;
      if (!guard.monitor) return Crowd::mixed;
      const Crowd found = once ? find_crossing(k, first, length) : Crowd::too_wide;
      if (found == Crowd::mixed) return found;
      if (found == Crowd::too_wide) crowd = found;
    }
    return crowd;
  }

  Crowd find_crossing(std::size_t k, int first, double length) {
    const GuardPolynomials::Error error = polynomials_.error(k);
    const double room = thresholds::crossing_roundings * thresholds::eps *
                        (std::abs(t0_) + polynomials_.point(first) + length);
    const auto u = polynomials_.crossing(k, first, error.sum(), room);
    if (u) crowd_.push_back({*u, k, thresholds::passed_error * error.sum()});
    return u ? Crowd::located : error.is_truncated() ? Crowd::too_wide : Crowd::mixed;
  }

  /// The first point at which an active guard has fired; degree + 1 if there is none.
  int first_fired(std::size_t i) const {
    int j = 1;
    while (j <= GuardPolynomials::degree && !fired(i, polynomials_.values(j))) ++j;
    return j;
  }
  bool stays_fired(std::size_t i, int first) const {
    for (int j = first; j <= GuardPolynomials::degree; ++j)
      if (!fired(i, polynomials_.values(j))) return false;
    return true;
  }

  /// Notes the crossings of a crowd in the order of time.
  void note_crowd() {
    std::ranges::stable_sort(crowd_, {}, &Member::u);
    for (const Member& member : crowd_) {
      const Guard& guard = (*guards_)[member.slot];
      guards_->monitors.push_back({t0_ + member.u, {static_cast<int>(member.slot), guard.side}});
      guards_->pass(member.slot, -guard.side, member.error);
    }
  }

  GuardPolynomials polynomials_;
  std::vector<Member> crowd_;
};

}  // namespace saltus
