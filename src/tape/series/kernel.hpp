// Makes a Kernel of a struct whose `order<slot>` computes one order.
#pragma once

#include "kernels.hpp"
#include "sums.hpp"

namespace saltus::tape::series {

/// Runs the next call, as a jump if the compiler sees that nothing is left to do here.
#define SALTUS_SERIES_NEXT call[1].run(call + 1, rows, sums, values, k)

template <class K>
void run_begin(const Call* call, double* rows, double* sums, const double* values, Index k) {
  K::begin(*call->instruction, sums + call->own, values);
  SALTUS_SERIES_NEXT;
}
template <class K>
void run_earlier(const Call* call, double* rows, double* sums, const double* values, Index k) {
  K::earlier(*call->instruction, rows, sums + call->own, k);
  SALTUS_SERIES_NEXT;
}
template <class K, int slot>
void run_order(const Call* call, double* rows, double* sums, const double* values, Index k) {
  K::template order<slot>(*call->instruction, rows, sums + call->own, values, k);
  SALTUS_SERIES_NEXT;
}

template <class K>
constexpr Kernel kernel() {
  Kernel made;
  if constexpr (requires { &K::begin; }) made.begin = &run_begin<K>;
  if constexpr (requires { &K::earlier; }) made.earlier = &run_earlier<K>;
  [&]<int... slot>(std::integer_sequence<int, slot...>) {
    ((made.orders[slot + 1] = &run_order<K, slot + 1>), ...);
  }(std::make_integer_sequence<int, 7>{});
  return made;
}

/// A kernel without sums: the coefficient of order k is K::at.
template <class K>
struct Plain {
  template <int slot>
  static void order(const Instruction& i, double* rows, double* own, const double* values,
                    Index k) {
    rows[i.to + k] = K::at(i, rows, own, values, k);
  }
};

inline double number(Index k) { return static_cast<double>(k); }

/// 1 / k.
inline constexpr auto inverse = [] {
  std::array<double, row_size> all{};
  for (std::size_t k = 1; k < row_size; ++k) all[k] = 1.0 / static_cast<double>(k);
  return all;
}();
inline double inverse_of(Index k) { return inverse[static_cast<std::size_t>(k)]; }

}  // namespace saltus::tape::series
