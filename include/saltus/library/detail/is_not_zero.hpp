// The truth of a number at an input that decides: every number except 0 counts as true.
#pragma once

#include <cmath>
#include <vector>

#include "saltus/model/event.hpp"

namespace saltus::detail {

/// The relation |u| > 0 of the scalar input `input`. A number that moves through zero leaves the guard
/// on its side, so only a number that rests at zero is false. A held input needs no guard.
inline Relation is_not_zero(int input) {
  return {.name = "not_zero",
          .true_at_zero = false,
          .reads = Reads::inputs,
          .inputs = std::vector{input},
          .formula = [=](const auto& at) {
            using std::abs;
            return abs(at.u(input));
          }};
}

}  // namespace saltus::detail
