// Kinks: whether a function with a switch at its limit has a derivative there.
#pragma once

#include <functional>

#include <Eigen/Core>

#include "saltus/base/view.hpp"

namespace saltus {

/// Whether one of these switches (see tape/switches.hpp) is at its limit.
bool has_switch_at_limit(const double* numbers, Index switches);

/// Whether values and derivatives, here and moved by a shift, differ on both sides. A switch at its
/// limit is a kink only then: v |v| has none at v = 0. `size` is that of the value that moves.
bool has_kink(const std::function<Eigen::ArrayXd(double shift)>& values_at, double size);

}  // namespace saltus
