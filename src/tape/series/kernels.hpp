// The kernels: the recurrence of each operation, for order k >= 1. The result is r.
#pragma once

#include "program.hpp"

namespace saltus::tape::series {

// linear
extern const Kernel plus;         ///< a + b
extern const Kernel minus;        ///< a - b
extern const Kernel multiple;     ///< a times the value of b
extern const Kernel combination;  ///< the sum of its terms
extern const Kernel copies;       ///< its terms; wide only
extern const Kernel next;         ///< of states, from multiples of their rates; wide only
// products
extern const Kernel product;   ///< a b
extern const Kernel square;    ///< a a
extern const Kernel quotient;  ///< a times a value, divided by b
extern const Kernel root;      ///< sqrt(a)
extern const Kernel power;     ///< a to the value of b
// integrals
extern const Kernel growth;     ///< r' = factor a' b, where b may depend on r
extern const Kernel rotation;   ///< r = sin(a) and second = cos(a); with factor 1 sinh and cosh
extern const Kernel logarithm;  ///< r' = factor a' / b
extern const Kernel angle;      ///< r' = a / b, where a_k is k times a coefficient
extern const Kernel turn;       ///< r_k: k times the coefficient of the integral of b a' - a b'
// kinks
extern const Kernel magnitude;  ///< factor |a|, factor by the sign of b if `op` is copysign
extern const Kernel extreme;    ///< minimum and maximum of a and b
extern const Kernel choice;     ///< a or b
extern const Kernel remainder;  ///< a minus a whole multiple of b

}  // namespace saltus::tape::series
