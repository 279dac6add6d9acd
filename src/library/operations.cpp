// The values of operations, by the functions that a tape runs.
#include "saltus/library/detail/operations.hpp"

#include "../tape/arithmetic.hpp"

namespace saltus::detail {

double operation(tape::Op op, double a) { return tape::compute(op, a, 0.0, 0.0); }
double operation(tape::Op op, double a, double b) { return tape::compute(op, a, b, 0.0); }

}  // namespace saltus::detail
