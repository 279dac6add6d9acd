// Sums, differences and multiples. In lanes, the terms of each stand one after the other.
#include "kernel.hpp"

namespace saltus::tape::series {

namespace {

struct Sum {
  static double narrow(const Instruction& i, const double* rows, const double*) {
    return rows[i.a] + rows[i.b];
  }
  static double lane(const Term* t, Index, const double* rows, const double*) {
    return rows[t[0].row] + rows[t[1].row];
  }
};
struct Difference {
  static double narrow(const Instruction& i, const double* rows, const double*) {
    return rows[i.a] - rows[i.b];
  }
  static double lane(const Term* t, Index, const double* rows, const double*) {
    return rows[t[0].row] - rows[t[1].row];
  }
};
struct Multiple {
  static double narrow(const Instruction& i, const double* rows, const double* values) {
    return values[i.of_b] * rows[i.a];
  }
  static double lane(const Term* t, Index, const double* rows, const double* values) {
    return values[t->factor] * rows[t->row];
  }
};
struct Combination {
  static double lane(const Term* t, Index count, const double* rows, const double* values) {
    double sum = 0.0;
    for (const Term* const end = t + count; t != end; ++t) sum += values[t->factor] * rows[t->row];
    return sum;
  }
  static double narrow(const Instruction& i, const double* rows, const double* values) {
    return lane(i.term, i.terms, rows, values);
  }
};
struct Copy {
  static double lane(const Term* t, Index, const double* rows, const double*) {
    return rows[t->row];
  }
};

template <class K>
void run_narrow(const Call* call, double* rows, double* sums, const double* values, Index k) {
  const Instruction& i = *call->instruction;
  rows[i.to + k] = K::narrow(i, rows + k, values);
  SALTUS_SERIES_NEXT;
}

template <class K>
void run_lanes(const Call* call, double* rows, double* sums, const double* values, Index k) {
  const Instruction& i = *call->instruction;
  const auto lane = [&, from = rows + lanes * k](Index l) {
    return K::lane(i.term + l * i.terms, i.terms, from, values);
  };
  // whole registers are stored: a load of two numbers would wait for two stores of one
  Four{Two{lane(0), lane(1)}, Two{lane(2), lane(3)}}.store(rows + i.to + lanes * k);
  SALTUS_SERIES_NEXT;
}

constexpr Handlers all_orders(Handler handler) {
  Handlers made;
  for (std::size_t slot = 1; slot < 8; ++slot) made.orders[slot] = handler;
  return made;
}
template <class K>
constexpr Kernel linear() {
  return {all_orders(&run_narrow<K>), all_orders(&run_lanes<K>), {.linear = true}};
}

}  // namespace

const Kernel plus = linear<Sum>();
const Kernel minus = linear<Difference>();
const Kernel multiple = linear<Multiple>();
const Kernel combination = linear<Combination>();
const Kernel copies = {{}, all_orders(&run_lanes<Copy>), {.linear = true}};

}  // namespace saltus::tape::series
