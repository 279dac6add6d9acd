#include "wide.hpp"

#include "kernel.hpp"

namespace saltus::tape::series {

namespace {

using Wanted = Index Instruction::*;

/// The coefficients of order k of a wide row.
[[gnu::always_inline]] inline Four at(const double* row, Index k) {
  return Four::load(static_cast<const double*>(__builtin_assume_aligned(row + lanes * k, 16)));
}

/// The sum of u_j v_{k-j} for j = 1 ... k - 1.
[[gnu::always_inline]] inline Four inner_wide(const double* u, const double* v, Index k) {
  Four even, odd;
  Index j = 1;
  for (; j + 1 < k; j += 2) {
    even += at(u, j) * at(v, k - j);
    odd += at(u, j + 1) * at(v, k - j - 1);
  }
  if (j < k) even += at(u, j) * at(v, k - j);
  return even + odd;
}
[[gnu::always_inline]] inline Four inner_square_wide(const double* u, Index k) {
  Four sum;
  for (Index j = 1; 2 * j < k; ++j) sum += at(u, j) * at(u, k - j);
  sum = 2.0 * sum;
  if (k % 2 == 0 && k > 0) sum += at(u, k / 2) * at(u, k / 2);
  return sum;
}

/// A value of each lane.
Four gathered(const WideInstruction& i, Wanted value, const double* values) {
  double all[lanes];
  for (std::size_t l = 0; l < lanes; ++l) all[l] = values[i.narrow[l]->*value];
  return Four::load(all);
}
Four inverse_value(const WideInstruction& i, Wanted value, const double* values) {
  return Four::all(1.0) / gathered(i, value, values);
}

const WideInstruction& of(const Call* call) {
  return static_cast<const WideInstruction&>(*call->instruction);
}

/// The numbers of an operand of which no row is needed, from anywhere.
[[gnu::always_inline]] inline Four scattered(const WideInstruction& i, const double* rows,
                                             Index k) {
  const double* const from = rows + lanes * k;
  const auto& at_lane = i.a_of_lane;
  return {Two{from[at_lane[0]], from[at_lane[1]]}, Two{from[at_lane[2]], from[at_lane[3]]}};
}

/// Linear kernels: `of_lane` computes a lane from its terms.
template <class K>
void run_linear(const Call* call, double* rows, double* sums, const double* values, Index k) {
  const Instruction& i = *call->instruction;
  const double* const from = rows + lanes * k;
  const auto lane = [&](Index l) {
    return K::of_lane(i.term + l * i.terms, i.terms, from, values);
  };
  // whole registers are stored: a load of two numbers would wait for two stores of one
  Four{Two{lane(0), lane(1)}, Two{lane(2), lane(3)}}.store(rows + i.to + lanes * k);
  SALTUS_SERIES_NEXT;
}
struct WideSum {
  [[gnu::always_inline]] static double of_lane(const Term* t, Index, const double* rows,
                                               const double*) {
    return rows[t[0].row] + rows[t[1].row];
  }
};
struct WideDifference {
  [[gnu::always_inline]] static double of_lane(const Term* t, Index, const double* rows,
                                               const double*) {
    return rows[t[0].row] - rows[t[1].row];
  }
};
struct WideMultiple {
  [[gnu::always_inline]] static double of_lane(const Term* t, Index, const double* rows,
                                               const double* values) {
    return values[t->factor] * rows[t->row];
  }
};
struct WideCombination {
  static double of_lane(const Term* t, Index count, const double* rows, const double* values) {
    double sum = 0.0;
    for (Index n = 0; n < count; ++n) sum += values[t[n].factor] * rows[t[n].row];
    return sum;
  }
};
struct Copy {
  [[gnu::always_inline]] static double of_lane(const Term* t, Index, const double* rows,
                                               const double*) {
    return rows[t->row];
  }
};

struct WideProduct {
  static void begin(const WideInstruction& i, double* own, const double* values) {
    gathered(i, &Instruction::of_a, values).store(own);
    gathered(i, &Instruction::of_b, values).store(own + 4);
  }
  static Four order(const WideInstruction& i, double* rows, const double* own, Index k) {
    const double *a = rows + i.a, *b = rows + i.b;
    const Four known = inner_wide(a, b, k) + at(own, 1) * at(a, k);
    return known + at(own, 0) * at(b, k);
  }
};

struct WideSquare {
  static void begin(const WideInstruction& i, double* own, const double* values) {
    (2.0 * gathered(i, &Instruction::of_a, values)).store(own);
  }
  static Four order(const WideInstruction& i, double* rows, const double* own, Index k) {
    return inner_square_wide(rows + i.a, k) + at(own, 0) * at(rows + i.a, k);
  }
};

struct WideQuotient {
  static void begin(const WideInstruction& i, double* own, const double* values) {
    const Four inverse = inverse_value(i, &Instruction::of_b, values);
    inverse.store(own);
    (inverse * gathered(i, &Instruction::value, values)).store(own + 4);
    gathered(i, &Instruction::of_a, values).store(own + 8);
  }
  static Four order(const WideInstruction& i, double* rows, const double* own, Index k) {
    const double* b = rows + i.b;
    const Four known = at(own, 2) * scattered(i, rows, k) - inner_wide(b, rows + i.to, k);
    return known * at(own, 0) - at(own, 1) * at(b, k);
  }
};

struct WideRoot {
  static void begin(const WideInstruction& i, double* own, const double* values) {
    (0.5 * inverse_value(i, &Instruction::value, values)).store(own);
  }
  static Four order(const WideInstruction& i, double* rows, const double* own, Index k) {
    return (scattered(i, rows, k) - inner_square_wide(rows + i.to, k)) * at(own, 0);
  }
};

struct WidePower {
  static void begin(const WideInstruction& i, double* own, const double* values) {
    const Four inverse = inverse_value(i, &Instruction::of_a, values);
    const Four p = gathered(i, &Instruction::of_b, values);
    inverse.store(own);
    (p * gathered(i, &Instruction::value, values) * inverse).store(own + 4);
    p.store(own + 8);
  }
  static Four order(const WideInstruction& i, double* rows, const double* own, Index k) {
    const double *a = rows + i.a, *r = rows + i.to, *da = rows + i.da, *dr = rows + i.db;
    const Four known = at(own, 2) * inner_wide(r, da, k) - inner_wide(dr, a, k);
    const Four result = known * (inverse_of(k) * at(own, 0)) + at(own, 1) * at(a, k);
    (number(k) * at(a, k)).store(rows + i.da + lanes * k);
    (number(k) * result).store(rows + i.db + lanes * k);
    return result;
  }
};

struct WideGrowth {
  static void begin(const WideInstruction& i, double* own, const double* values) {
    (i.factor * gathered(i, &Instruction::of_b, values)).store(own);
  }
  static Four order(const WideInstruction& i, double* rows, const double* own, Index k) {
    const Four a = scattered(i, rows, k);
    const Four known = inner_wide(rows + i.da, rows + i.b, k);
    (number(k) * a).store(rows + i.da + lanes * k);
    return i.factor * inverse_of(k) * known + at(own, 0) * a;
  }
};

struct WideRotation {
  static void begin(const WideInstruction& i, double* own, const double* values) {
    gathered(i, &Instruction::of_b, values).store(own);
    (i.factor * gathered(i, &Instruction::value, values)).store(own + 4);
  }
  static Four order(const WideInstruction& i, double* rows, const double* own, Index k) {
    const Four a = scattered(i, rows, k);
    const Four with_c = inner_wide(rows + i.da, rows + i.to_second, k);
    const Four with_s = inner_wide(rows + i.da, rows + i.to, k);
    (number(k) * a).store(rows + i.da + lanes * k);
    (i.factor * inverse_of(k) * with_s + at(own, 1) * a).store(rows + i.to_second + lanes * k);
    return inverse_of(k) * with_c + at(own, 0) * a;
  }
};

struct WideLogarithm {
  static void begin(const WideInstruction& i, double* own, const double* values) {
    const Four inverse = inverse_value(i, &Instruction::of_b, values);
    inverse.store(own);
    (i.factor * inverse).store(own + 4);
  }
  static Four order(const WideInstruction& i, double* rows, const double* own, Index k) {
    const Four known = inner_wide(rows + i.db, rows + i.b, k) * (inverse_of(k) * at(own, 0));
    const Four result = at(own, 1) * scattered(i, rows, k) - known;
    (number(k) * result).store(rows + i.db + lanes * k);
    return result;
  }
};

template <class K>
void run_wide_begin(const Call* call, double* rows, double* sums, const double* values, Index k) {
  K::begin(of(call), sums + call->own, values);
  SALTUS_SERIES_NEXT;
}
template <class K>
void run_wide(const Call* call, double* rows, double* sums, const double* values, Index k) {
  const WideInstruction& i = of(call);
  K::order(i, rows, sums + call->own, k).store(rows + i.to + lanes * k);
  SALTUS_SERIES_NEXT;
}

template <class K>
constexpr WideKernel linear(const Kernel& narrow) {
  return {.narrow = &narrow, .order = &run_linear<K>, .linear = true};
}
template <class K>
constexpr WideKernel nonlinear(const Kernel& narrow, WideKernel rest) {
  rest.narrow = &narrow;
  rest.begin = &run_wide_begin<K>;
  rest.order = &run_wide<K>;
  return rest;
}

const WideKernel all[] = {
    linear<WideSum>(plus),
    linear<WideDifference>(minus),
    linear<WideMultiple>(multiple),
    linear<WideCombination>(combination),
    nonlinear<WideProduct>(product, {.reads_row_a = true, .reads_b = true}),
    nonlinear<WideSquare>(square, {.reads_row_a = true}),
    nonlinear<WideQuotient>(quotient, {.reads_b = true}),
    nonlinear<WideRoot>(root, {}),
    nonlinear<WidePower>(power, {.reads_row_a = true, .has_da = true, .has_dr = true}),
    nonlinear<WideGrowth>(growth, {.reads_b = true, .has_da = true}),
    nonlinear<WideRotation>(rotation, {.has_second = true, .has_da = true}),
    nonlinear<WideLogarithm>(logarithm, {.reads_b = true, .has_dr = true}),
};

}  // namespace

const Handler pack = &run_linear<Copy>;

void Wide::store_states(const double* x, Index n, double* rows_of_order) const {
  double* to = rows_of_order + states;
  Index i = 0;
  for (; i + lanes <= n; i += lanes, to += wide_row_size) {
    Four{Two{x[i], x[i + 1]}, Two{x[i + 2], x[i + 3]}}.store(to);
  }
  for (; i < n; ++i, ++to) *to = x[i];
}

const WideKernel* wide_kernel(const Kernel* narrow) {
  const auto found = std::ranges::find(all, narrow, &WideKernel::narrow);
  return found == std::end(all) ? nullptr : &*found;
}

}  // namespace saltus::tape::series
