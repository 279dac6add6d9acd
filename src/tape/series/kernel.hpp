// Makes a Kernel of a struct with the recurrence, for single numbers and for four lanes.
#pragma once

#include <array>

#include "kernels.hpp"
#include "saltus/base/view.hpp"
#include "sums.hpp"
#include "wide.hpp"
#include "written.hpp"

namespace saltus::tape::series {

inline double number(Index k) { return static_cast<double>(k); }

/// 1 / k.
inline constexpr auto inverse = [] {
  std::array<double, row_size> all{};
  for (std::size_t k = 1; k < row_size; ++k) all[k] = 1.0 / static_cast<double>(k);
  return all;
}();
inline double inverse_of(Index k) { return inverse[static_cast<std::size_t>(k)]; }

/// The place of order k among the handlers of a kernel.
constexpr std::size_t slot_of(int k) { return static_cast<std::size_t>(k < 4 ? k : 4 + k % 4); }
constexpr bool begins_block(int k) { return k >= 4 && k % 4 == 0; }

/// The coefficient of order k + 1 of a state, from that of order k of its rate. `rows` begin at
/// order k; `values` and `rows` have numbers by place.
template <class Values, class Rows>
auto slope_of(const Rate& rate, const Values& values, const Rows& rows, int k) {
  if (k == 0) return values[rate.value];
  return values[rate.term.factor] * inverse_of(k + 1) * rows[rate.term.row];
}

/// The data of `begin` of a recurrence: the values, and the numbers that it keeps.
template <class N>
struct Start {
  const Instruction& i;
  double* own;
  const double* values;

  N value(Index Instruction::*which) const {
    if constexpr (width<N> == 1) {
      return values[i.*which];
    } else {
      const auto& narrow = static_cast<const WideInstruction&>(i).narrow;
      const auto of_lane = [&](std::size_t l) { return values[narrow[l]->*which]; };
      return {Two{of_lane(0), of_lane(1)}, Two{of_lane(2), of_lane(3)}};
    }
  }
  void keep(Index n, const N& a) const { put(own + width<N> * (8 + n), a); }
};

/// The data of one order of a recurrence.
template <class N>
struct Work {
  const Instruction& i;
  double *rows, *own;
  Index k;

  Row<N> row(Index at) const { return {rows + at}; }
  /// The coefficient of order k of an operand a, if the recurrence reads only this one.
  [[gnu::always_inline]] N newest() const {
    if constexpr (width<N> == 1) {
      return rows[i.a + k];
    } else {
      const auto& place = static_cast<const WideInstruction&>(i).a_of_lane;
      const double* const from = rows + lanes * k;
      return {Two{from[place[0]], from[place[1]]}, Two{from[place[2]], from[place[3]]}};
    }
  }
  Row<N> sums() const { return {own}; }
  Row<N> second_sums() const { return {own + width<N> * 4}; }
  N kept(Index n) const { return Row<N>{own}[8 + n]; }
  void set(Index to, const N& a) const { put(rows + to + width<N> * k, a); }

  void add_earlier(Index u, Index v) const { earlier_product(row(u), row(v), k, own); }
  void add_earlier_square(Index u) const { earlier_square(row(u), k, own); }
  void add_second(Index u, Index v) const {
    earlier_product(row(u), row(v), k, own + width<N> * 4);
  }
};

/// The same data for a recurrence that is written as machine code.
template <>
struct Start<Written> {
  const Instruction& i;
  WrittenPlace own;

  Written value(Index Instruction::*which) const {
    SeriesWriter& writer = *own.writer;
    if (writer.width == 1) return writer.value(i.*which);
    const auto& narrow = static_cast<const WideInstruction&>(i).narrow;
    const auto of_lane = [&](std::size_t l) { return writer.value(narrow[l]->*which); };
    return writer.joined({of_lane(0), of_lane(1), of_lane(2), of_lane(3)});
  }
  void keep(Index n, const Written& a) const { put(own + own.writer->width * (8 + n), a); }
};
template <>
struct Work<Written> {
  const Instruction& i;
  WrittenPlace rows, own;
  Index k;

  int width() const { return own.writer->width; }
  Row<Written> row(Index at) const { return {rows + at, width()}; }
  Written newest() const {
    if (width() == 1) return row(i.a)[k];
    auto places = static_cast<const WideInstruction&>(i).a_of_lane;
    for (Index& place : places) place += lanes * k;
    return own.writer->gathered(Memory::rows, places);
  }
  Row<Written> sums() const { return {own, width()}; }
  Row<Written> second_sums() const { return {own + 4 * width(), width()}; }
  Written kept(Index n) const { return sums()[8 + n]; }
  void set(Index to, const Written& a) const { put(rows + (to + width() * k), a); }

  void add_earlier(Index u, Index v) const { earlier_product(row(u), row(v), k, own); }
  void add_earlier_square(Index u) const { earlier_square(row(u), k, own); }
  void add_second(Index u, Index v) const { earlier_product(row(u), row(v), k, own + 4 * width()); }
};

/// Begins a recurrence that needs the values of both operands.
struct OfTwo {
  template <class N>
  static void begin(Start<N> s) {
    s.keep(0, s.value(&Instruction::of_a));
    s.keep(1, s.value(&Instruction::of_b));
  }
};

/// Runs the next call, as a jump if the compiler sees that nothing is left to do here.
#define SALTUS_SERIES_NEXT call[1].run(call + 1, rows, sums, values, k)

template <class K, class N>
void run_begin(const Call* call, double* rows, double* sums, const double* values, Index k) {
  K::begin(Start<N>{*call->instruction, sums + call->own, values});
  SALTUS_SERIES_NEXT;
}
template <class K, class N>
void run_earlier(const Call* call, double* rows, double* sums, const double* values, Index k) {
  K::earlier(Work<N>{*call->instruction, rows, sums + call->own, k});
  SALTUS_SERIES_NEXT;
}
template <class K, class N, int slot>
void run_order(const Call* call, double* rows, double* sums, const double* values, Index k) {
  K::template order<slot>(Work<N>{*call->instruction, rows, sums + call->own, k});
  SALTUS_SERIES_NEXT;
}

template <class K, class N>
constexpr Handlers handlers() {
  Handlers made;
  if constexpr (requires(Start<N> s) { K::begin(s); }) made.begin = &run_begin<K, N>;
  if constexpr (requires(Work<N> w) { K::earlier(w); }) made.earlier = &run_earlier<K, N>;
  [&]<int... slot>(std::integer_sequence<int, slot...>) {
    ((made.orders[slot + 1] = &run_order<K, N, slot + 1>), ...);
  }(std::make_integer_sequence<int, 7>{});
  return made;
}

template <class K>
void write_begin(SeriesWriter& writer, const Instruction& i, Index own, Index) {
  K::begin(Start<Written>{i, {&writer, Memory::own, own}});
}
template <class K>
Work<Written> written_work(SeriesWriter& writer, const Instruction& i, Index own, Index k) {
  return {i, {&writer, Memory::rows, 0}, {&writer, Memory::own, own}, k};
}
template <class K>
void write_earlier(SeriesWriter& writer, const Instruction& i, Index own, Index k) {
  K::earlier(written_work<K>(writer, i, own, k));
}
template <class K, int slot>
void write_order(SeriesWriter& writer, const Instruction& i, Index own, Index k) {
  K::template order<slot>(written_work<K>(writer, i, own, k));
}

template <class K>
constexpr WriteHandlers writers() {
  WriteHandlers made{.begin = &write_begin<K>, .earlier = &write_earlier<K>};
  [&]<int... slot>(std::integer_sequence<int, slot...>) {
    ((made.orders[slot + 1] = &write_order<K, slot + 1>), ...);
  }(std::make_integer_sequence<int, 7>{});
  return made;
}

/// A recurrence for numbers, for lanes and for machine code.
template <class K>
constexpr Kernel kernel(Reads reads) {
  return {handlers<K, double>(), handlers<K, Four>(), reads, writers<K>()};
}

}  // namespace saltus::tape::series
