// Sums, differences and multiples. Of wide ones term n of lane l is number 4 n + l.
#include "kernel.hpp"

namespace saltus::tape::series {

namespace {

/// Number l stands at the place of term l.
[[gnu::always_inline]] inline Four gathered(const Term* term, const double* from) {
  return {Two{from[term[0].row], from[term[1].row]}, Two{from[term[2].row], from[term[3].row]}};
}

struct Sum {
  static double narrow(const Instruction& i, const double* rows, const double*) {
    return rows[i.a] + rows[i.b];
  }
  static Four wide(const Instruction& i, const double* rows, const double*) {
    return gathered(i.term, rows) + gathered(i.term + lanes, rows);
  }
};
struct Difference {
  static double narrow(const Instruction& i, const double* rows, const double*) {
    return rows[i.a] - rows[i.b];
  }
  static Four wide(const Instruction& i, const double* rows, const double*) {
    return gathered(i.term, rows) - gathered(i.term + lanes, rows);
  }
};
struct Combination {
  static double narrow(const Instruction& i, const double* rows, const double* values) {
    double sum = 0.0;
    for (const Term& term : std::span(i.term, static_cast<std::size_t>(i.terms))) {
      sum += values[term.factor] * rows[term.row];
    }
    return sum;
  }
  /// `begin_wide` has gathered the factors.
  static Four wide(const Instruction& i, const double* rows, const double* own) {
    const Row<Four> factors{own};
    Four sum = factors[0] * gathered(i.term, rows);
    for (Index n = 1; n < i.terms; ++n) {
      sum += factors[n] * gathered(i.term + lanes * n, rows);
    }
    return sum;
  }
};
struct Multiple {
  static double narrow(const Instruction& i, const double* rows, const double* values) {
    return values[i.of_b] * rows[i.a];
  }
  static Four wide(const Instruction& i, const double* rows, const double* own) {
    return Row<Four>{own}[0] * gathered(i.term, rows);
  }
};
struct Copy {
  static Four wide(const Instruction& i, const double* rows, const double*) {
    return gathered(i.term, rows);
  }
};

void begin_wide(const Call* call, double* rows, double* sums, const double* values, Index k) {
  const Instruction& i = *call->instruction;
  double* own = sums + call->own;
  for (Index n = 0; n < lanes * i.terms; ++n) own[n] = values[i.term[n].factor];
  SALTUS_SERIES_NEXT;
}

template <class K>
void run_narrow(const Call* call, double* rows, double* sums, const double* values, Index k) {
  const Instruction& i = *call->instruction;
  rows[i.to + k] = K::narrow(i, rows + k, values);
  SALTUS_SERIES_NEXT;
}
template <class K>
void run_wide(const Call* call, double* rows, double* sums, const double* values, Index k) {
  const Instruction& i = *call->instruction;
  K::wide(i, rows + lanes * k, sums + call->own).store(rows + i.to + lanes * k);
  SALTUS_SERIES_NEXT;
}
void run_next(const Call* call, double* rows, double* sums, const double* values, Index k) {
  const Instruction& i = *call->instruction;
  const Four rates = Multiple::wide(i, rows + lanes * k, sums + call->own);
  (inverse_of(k + 1) * rates).store(rows + i.to + lanes * (k + 1));
  SALTUS_SERIES_NEXT;
}

constexpr Handlers all_orders(Handler handler, Handler begin = nullptr) {
  Handlers made{.begin = begin};
  for (std::size_t slot = 1; slot < 8; ++slot) made.orders[slot] = handler;
  return made;
}
template <class K>
constexpr Kernel linear(Handler begin = nullptr) {
  return {all_orders(&run_narrow<K>), all_orders(&run_wide<K>, begin), {.linear = true}};
}

}  // namespace

const Kernel plus = linear<Sum>();
const Kernel minus = linear<Difference>();
const Kernel multiple = linear<Multiple>(&begin_wide);
const Kernel combination = linear<Combination>(&begin_wide);
const Kernel copies = {{}, all_orders(&run_wide<Copy>), {.linear = true}};
const Kernel next = {{}, all_orders(&run_next, &begin_wide), {.linear = true}};

}  // namespace saltus::tape::series
