// Sums, differences and multiples. In a wide instruction term n of lane l is number 4 n + l.
#include "kernel.hpp"

namespace saltus::tape::series {

namespace {

/// Number l is the coefficient at the place of term l.
[[gnu::always_inline]] inline Four gathered(const Term* term, const double* from) {
  return {Two{from[term[0].row], from[term[1].row]}, Two{from[term[2].row], from[term[3].row]}};
}
Written gathered(const Term* term, const WrittenNumbers& from) {
  const auto place = [&](int l) { return term[l].row + from.shift; };
  return from.writer->gathered(from.memory, {place(0), place(1), place(2), place(3)});
}

/// `rows` and `values` are indexed by place; `factors` has the numbers that `begin_wide` gathered.
struct Sum {
  template <class Numbers>
  static auto narrow(const Instruction& i, const Numbers& rows, const Numbers&) {
    return rows[i.a] + rows[i.b];
  }
  template <class Numbers, class N>
  static N wide(const Instruction& i, const Numbers& rows, Row<N>) {
    return gathered(i.term, rows) + gathered(i.term + lanes, rows);
  }
};
struct Difference {
  template <class Numbers>
  static auto narrow(const Instruction& i, const Numbers& rows, const Numbers&) {
    return rows[i.a] - rows[i.b];
  }
  template <class Numbers, class N>
  static N wide(const Instruction& i, const Numbers& rows, Row<N>) {
    return gathered(i.term, rows) - gathered(i.term + lanes, rows);
  }
};
struct Combination {
  template <class Numbers>
  static auto narrow(const Instruction& i, const Numbers& rows, const Numbers& values) {
    std::remove_cvref_t<decltype(rows[0])> sum{};
    for (const Term& term : std::span(i.term, static_cast<std::size_t>(i.terms))) {
      sum += values[term.factor] * rows[term.row];
    }
    return sum;
  }
  template <class Numbers, class N>
  static N wide(const Instruction& i, const Numbers& rows, Row<N> factors) {
    N sum = factors[0] * gathered(i.term, rows);
    for (Index n = 1; n < i.terms; ++n) {
      sum += factors[n] * gathered(i.term + lanes * n, rows);
    }
    return sum;
  }
};
struct Multiple {
  template <class Numbers>
  static auto narrow(const Instruction& i, const Numbers& rows, const Numbers& values) {
    return values[i.of_b] * rows[i.a];
  }
  template <class Numbers, class N>
  static N wide(const Instruction& i, const Numbers& rows, Row<N> factors) {
    return factors[0] * gathered(i.term, rows);
  }
};
struct Copy {
  template <class Numbers, class N>
  static N wide(const Instruction& i, const Numbers& rows, Row<N>) {
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
  rows[i.to + k] = K::template narrow<const double*>(i, rows + k, values);
  SALTUS_SERIES_NEXT;
}
template <class K>
void run_wide(const Call* call, double* rows, double* sums, const double* values, Index k) {
  const Instruction& i = *call->instruction;
  K::template wide<const double*>(i, rows + lanes * k, Row<Four>{sums + call->own})
      .store(rows + i.to + lanes * k);
  SALTUS_SERIES_NEXT;
}
void run_next(const Call* call, double* rows, double* sums, const double* values, Index k) {
  const Instruction& i = *call->instruction;
  const Four rates =
      Multiple::wide<const double*>(i, rows + lanes * k, Row<Four>{sums + call->own});
  (inverse_of(k + 1) * rates).store(rows + i.to + lanes * (k + 1));
  SALTUS_SERIES_NEXT;
}

void write_begin_wide(SeriesWriter& writer, const Instruction& i, Index own, Index) {
  if (writer.width == 1) return;
  for (Index n = 0; n < lanes * i.terms; n += lanes) {
    const auto of_lane = [&](Index l) { return writer.value(i.term[n + l].factor); };
    writer.store(Memory::own, own + n,
                 writer.joined({of_lane(0), of_lane(1), of_lane(2), of_lane(3)}));
  }
}
template <class K>
void write_linear(SeriesWriter& writer, const Instruction& i, Index own, Index k) {
  const WrittenNumbers rows{&writer, Memory::rows, writer.width * k};
  const Row<Written> factors{{&writer, Memory::own, own}, writer.width};
  const WrittenPlace to{&writer, Memory::rows, i.to + writer.width * k};
  if constexpr (requires { K::narrow(i, rows, rows); })
    if (writer.width == 1) return put(to, K::narrow(i, rows, {&writer, Memory::values, 0}));
  put(to, K::wide(i, rows, factors));
}
void write_next(SeriesWriter& writer, const Instruction& i, Index own, Index k) {
  const WrittenNumbers rows{&writer, Memory::rows, lanes * k};
  const Written rates = Multiple::wide(i, rows, Row<Written>{{&writer, Memory::own, own}, lanes});
  writer.store(Memory::rows, i.to + lanes * (k + 1), inverse_of(k + 1) * rates);
}

constexpr Handlers all_orders(Handler handler, Handler begin = nullptr) {
  Handlers made{.begin = begin};
  for (std::size_t slot = 1; slot < 8; ++slot) made.orders[slot] = handler;
  return made;
}
template <class K>
constexpr Kernel linear(Handler begin = nullptr) {
  return {all_orders(&run_narrow<K>),
          all_orders(&run_wide<K>, begin),
          {.linear = true},
          all_written(&write_linear<K>, begin == nullptr ? nullptr : &write_begin_wide)};
}

}  // namespace

const Kernel plus = linear<Sum>();
const Kernel minus = linear<Difference>();
const Kernel multiple = linear<Multiple>(&begin_wide);
const Kernel combination = linear<Combination>(&begin_wide);
const Kernel copies = {
    {}, all_orders(&run_wide<Copy>), {.linear = true}, all_written(&write_linear<Copy>)};
const Kernel next = {{},
                     all_orders(&run_next, &begin_wide),
                     {.linear = true},
                     all_written(&write_next, &write_begin_wide)};

}  // namespace saltus::tape::series
