// Makes a Kernel of a struct whose `order<slot>` computes one order.
#pragma once

#include "kernels.hpp"
#include "sums.hpp"

namespace saltus::tape::series {

template <class K>
constexpr Kernel kernel() {
  Kernel made;
  if constexpr (requires { &K::begin; }) made.begin = &K::begin;
  if constexpr (requires { &K::earlier; }) made.earlier = &K::earlier;
  [&]<int... slot>(std::integer_sequence<int, slot...>) {
    ((made.orders[slot + 1] = &K::template order<slot + 1>), ...);
  }(std::make_integer_sequence<int, 7>{});
  return made;
}

/// A kernel without sums: the coefficient of order k is K::at.
template <class K>
struct Plain {
  template <int slot>
  static void order(const Instruction& i, double* rows, double* own, const double* values, int k) {
    rows[i.to + k] = K::at(i, rows, own, values, k);
  }
};

/// 1 / k.
inline constexpr auto inverse = [] {
  std::array<double, row_size> all{};
  for (int k = 1; k < row_size; ++k) all[static_cast<std::size_t>(k)] = 1.0 / k;
  return all;
}();
inline double inverse_of(int k) { return inverse[static_cast<std::size_t>(k)]; }

}  // namespace saltus::tape::series
