// Runs: one operation on many adjacent numbers.
#include <array>
#include <utility>

#include "arithmetic.hpp"
#include "program.hpp"
#include "saltus/base/list.hpp"

namespace saltus::tape::detail {

namespace {

const double* first_of(const Place& place, const double* registers, const At& at) {
  switch (place.kind) {
    case Kind::reg:
      return registers + place.offset;
    case Kind::x:
      return at.x.data() + place.offset;
    case Kind::p:
      return at.p.data() + place.offset;
    case Kind::z:
      return at.z.data() + place.offset;
    case Kind::input:
      return at.u[place.port].data() + place.offset;
    default:
      return &place.value;  // constant
  }
}

/// The strides of a run if they are known at compile time: 0 or 1.
template <Op op, int step_a, int step_b>
void close(double* to, const double* a, const double* b, Index n) {
// a run does not read the numbers that it writes
#ifdef __clang__
#pragma clang loop vectorize(assume_safety)
#else
#pragma GCC ivdep
#endif
  for (Index i = 0; i < n; ++i) {
    to[i] = compute(op, a[step_a * i], operand_count(op) > 1 ? b[step_b * i] : 0.0, 0.0);
  }
}

template <Op op>
void apart(const Line& line, double* to, const std::array<const double*, 3>& from) {
  const Index s = line.to.stride, sa = line.from[0].stride, sb = line.from[1].stride,
              sc = line.from[2].stride;
  for (Index i = 0; i < static_cast<Index>(line.count); ++i) {
    const double b = operand_count(op) > 1 ? from[1][sb * i] : 0.0;
    const double c = operand_count(op) > 2 ? from[2][sc * i] : 0.0;
    to[s * i] = compute(op, from[0][sa * i], b, c);
  }
}

template <Op op>
double many(const Instruction* i, double before, double* registers, double* out, const At& at) {
  const Line& line = *i->line;
  std::array<const double*, 3> from{};
  for (std::size_t k = 0; k < line.operands(); ++k) from[k] = first_of(line.from[k], registers, at);
  double* const to = (line.to.kind == Kind::out ? out : registers) + line.to.offset;
  const auto n = static_cast<Index>(line.count);
  const auto steps = [&](int a, int b) {
    return line.to.stride == 1 && line.from[0].stride == a &&
           (operand_count(op) < 2 || line.from[1].stride == b);
  };
  if (operand_count(op) < 3 && steps(1, 1)) {
    close<op, 1, 1>(to, from[0], from[1], n);
  } else if (operand_count(op) == 2 && steps(0, 1)) {
    close<op, 0, 1>(to, from[0], from[1], n);
  } else if (operand_count(op) == 2 && steps(1, 0)) {
    close<op, 1, 0>(to, from[0], from[1], n);
  } else {
    apart<op>(line, to, from);
  }
  return i[1].run(i + 1, before, registers, out, at);
}

constexpr auto handlers = []<std::size_t... op>(std::index_sequence<op...>) {
  return std::array<Handler, sizeof...(op)>{&many<static_cast<Op>(op)>...};
}(std::make_index_sequence<operation_count>{});

}  // namespace

Handler vector_handler(Op op) { return nth(handlers, op); }

}  // namespace saltus::tape::detail
