// Each operation has the values and slopes that mpmath, Python and NumPy give, on a tape and in the
// arithmetic that random expressions are compared with.
#include <algorithm>
#include <cmath>
#include <iterator>

#include "saltus/tape/jacobian.hpp"
#include "support/catch.hpp"
#include "support/expressions.hpp"
#include "support/operation_values.hpp"
#include "support/tape_world.hpp"

using namespace saltus::tape;
using namespace support;

namespace {

/// Equal within two roundings: the functions of <cmath> are a little less exact than one.
bool close(double found, double stored) {
  if (stored == 0.0 || !std::isfinite(stored)) return same_bits(found, stored);
  return std::abs(found - stored) <= 2.0 * 0x1p-52 * std::abs(stored);
}

/// One operation of states 0, 1 and 2.
RandomExpression expression(Op op) {
  RandomExpression e;
  e.variables = 3;
  e.steps.resize(3);
  e.steps.push_back({op, {0, 1, 2}});
  e.outputs = {3};
  return e;
}

std::vector<double> operands(const OperationValue& row) {
  return {std::begin(row.operands), std::end(row.operands)};
}

template <class Act>
void for_each_row(Act act) {
  for (const OperationValue& row : operation_values::all) {
    INFO(name(row.op) << " of " << row.operands[0] << ", " << row.operands[1] << ", "
                      << row.operands[2]);
    act(row);
  }
}

}  // namespace

TEST_CASE("every operation has stored values", "[tape]") {
  for (int i = static_cast<int>(Op::neg); i < operation_count; ++i) {
    const auto op = static_cast<Op>(i);
    INFO(name(op));
    CHECK(std::ranges::count(operation_values::all, op, &OperationValue::op) >= 2);
  }
}

TEST_CASE("a tape and a folded constant have the stored values of each operation", "[tape]") {
  for_each_row([](const OperationValue& row) {
    Graph graph, folded;
    const Tape tape(graph, write(expression(row.op), graph));
    CHECK(close(values_of(tape, {.x = operands(row)})[0], row.value));
    std::vector<Node> constants;
    for (const double operand : row.operands) constants.push_back(folded.constant(operand));
    CHECK(close(*folded.value(write(expression(row.op), folded, constants)[0]), row.value));
  });
}

TEST_CASE("the arithmetic of random expressions has the stored values", "[tape]") {
  for_each_row([](const OperationValue& row) {
    const RandomExpression e = expression(row.op);
    const auto x = operands(row);
    CHECK(close(evaluate(e, x)[0], row.value));
    const auto longer = evaluate(e, std::vector<long double>(x.begin(), x.end()));
    CHECK(close(static_cast<double>(longer[0]), row.value));
  });
}

TEST_CASE("the derivative of each operation has the stored slopes", "[tape]") {
  for_each_row([](const OperationValue& row) {
    Graph graph;
    const Jacobian exact = jacobian(Tape(graph, write(expression(row.op), graph)));
    const auto found = values_of(exact.values, {.x = operands(row)});
    double slopes[3] = {};
    for (std::size_t k = 0; k < found.size(); ++k) slopes[exact.entries[k].column] = found[k];
    for (int i = 0; i < 3; ++i) {
      if (std::isnan(row.slopes[i])) continue;
      CHECK(std::abs(slopes[i] - row.slopes[i]) <= 1e-14 * std::abs(row.slopes[i]));
    }
  });
}
