"""Writes operation_values.hpp, run with mpmath and NumPy: what each operation of a tape means.

Functions of calculus are rounded from 40 digits; what has a rule of its own for signs, halves,
zeros and NaN is what Python (`//`, `%`) or NumPy (the other names) gives. Slopes are derivatives
in 40 digits, at points where there is one.
"""

import operator
from pathlib import Path

import mpmath
import numpy as np
from mpmath import mp

mp.dps = 40
NAN, INF = float("nan"), float("inf")

SMOOTH = {  # name -> the function in 40 digits, points
    "neg": (operator.neg, [-1.5, 3e10]),
    "sqrt": (mp.sqrt, [0.25, 2.0, 3e10]),
    "cbrt": (lambda a: mpmath.sign(a) * mp.cbrt(abs(a)), [-2.0, 0.3, 3e10]),
    "exp": (mp.exp, [-2.5, 0.1, 3.75]),
    "exp2": (lambda a: mp.mpf(2) ** a, [-2.5, 0.1, 3.75]),
    "expm1": (mp.expm1, [-0.5, 1e-9, 2.0]),
    "log": (mp.log, [0.3, 1.0000001, 50.0]),
    "log2": (lambda a: mp.log(a, 2), [0.3, 8.0, 50.0]),
    "log10": (mp.log10, [0.3, 100.0, 51.0]),
    "log1p": (mp.log1p, [-0.5, 1e-9, 4.0]),
    "sin": (mp.sin, [-1.1, 0.4, 30.0]),
    "cos": (mp.cos, [-1.1, 0.4, 30.0]),
    "tan": (mp.tan, [-1.1, 0.4, 30.0]),
    "asin": (mp.asin, [-0.9, 0.1, 0.75]),
    "acos": (mp.acos, [-0.9, 0.1, 0.75]),
    "atan": (mp.atan, [-2.0, 0.1, 35.0]),
    "sinh": (mp.sinh, [-2.0, 0.1, 3.5]),
    "cosh": (mp.cosh, [-2.0, 0.1, 3.5]),
    "tanh": (mp.tanh, [-2.0, 0.1, 1.5]),
    "asinh": (mp.asinh, [-2.0, 0.1, 35.0]),
    "acosh": (mp.acosh, [1.25, 3.0, 100.0]),
    "atanh": (mp.atanh, [-0.9, 0.1, 0.75]),
    "add": (operator.add, [(0.1, 0.2), (-3.0, 7e10)]),
    "sub": (operator.sub, [(0.1, 0.2), (-3.0, 7e10)]),
    "mul": (operator.mul, [(0.1, 0.2), (-3.0, 7e10)]),
    "div": (operator.truediv, [(0.1, 0.3), (-3.0, 7e10)]),
    "pow": (operator.pow, [(2.0, 0.5), (0.3, -1.7), (10.0, 3.0)]),
    "atan2": (mp.atan2, [(1.0, 2.0), (1.0, -2.0), (-1.0, -2.0), (-3.0, 0.5)]),
    "hypot": (mp.hypot, [(3.0, 4.0), (-0.3, 0.1)]),
}
PIECEWISE = {  # of slopes that are those of a piece: 1, 0, -1 or a whole quotient
    "abs": (abs, [-1.5, 0.25]),
    "copysign": (lambda a, b: abs(a) if b > 0 else -abs(a), [(1.5, -0.1), (-2.0, 3.0)]),
    "mod": (lambda a, b: a - b * mp.floor(a / b), [(5.3, 0.7), (-5.3, 0.7), (5.3, -0.7)]),
    "minimum": (min, [(1.0, 2.0), (2.0, -1.0)]),
    "maximum": (max, [(1.0, 2.0), (2.0, -1.0)]),
    "select": (lambda a, b, c: b if a != 0 else c, [(1.0, 5.0, 6.0), (0.0, 5.0, 6.0)]),
}
HALVES = [-2.5, -0.7, -0.5, -0.0, 0.5, 1.5, 2.5, 3.0, INF, NAN]
QUOTIENTS = [(7.0, 2.0), (-7.0, 2.0), (7.0, -2.0), (-7.0, -2.0), (1.0, 0.1), (-0.0, 3.0)]
PAIRS = [(1.0, 2.0), (2.0, 2.0), (3.0, 2.0), (-INF, 3.0), (NAN, 1.0), (1.0, NAN)]
TRUTHS = [(0.0, 0.0), (-0.0, 2.0), (3.0, -1.0), (NAN, 0.0), (5e-324, NAN)]
RULES = {  # name -> what says it, points
    "abs": (np.absolute, [-0.0, -INF, NAN]),
    "floor": (np.floor, HALVES),
    "ceil": (np.ceil, HALVES),
    "trunc": (np.trunc, HALVES),
    "rint": (np.rint, HALVES),
    "sign": (np.sign, [-2.5, 0.0, 5e-324, INF, NAN]),
    "logical_not": (np.logical_not, [0.0, -0.0, 5e-324, NAN]),
    "copysign": (np.copysign, [(1.5, -0.0), (-2.0, 0.0), (NAN, 1.0)]),
    "mod": (operator.mod, [*QUOTIENTS, (-1e-20, 3.0)]),
    "fmod": (np.fmod, [*QUOTIENTS, (5.3, 0.7), (-5.3, 0.7)]),
    "floor_divide": (operator.floordiv, [*QUOTIENTS, (5.3, 0.7), (-5.3, 0.7), (1e17, 3.0)]),
    "minimum": (np.minimum, PAIRS),
    "maximum": (np.maximum, PAIRS),
    "lt": (np.less, PAIRS),
    "le": (np.less_equal, PAIRS),
    "gt": (np.greater, PAIRS),
    "ge": (np.greater_equal, PAIRS),
    "eq": (np.equal, PAIRS),
    "ne": (np.not_equal, PAIRS),
    "logical_and": (np.logical_and, TRUTHS),
    "logical_or": (np.logical_or, TRUTHS),
    "select": (lambda a, b, c: b if a else c, [(-0.0, 5.0, 6.0), (NAN, 5.0, 6.0), (2.0, 5.0, NAN)]),
}


def literal(x):
    x = float(x)
    if np.isnan(x):
        return "none"
    return repr(x) if np.isfinite(x) else "-infinite" if x < 0 else "infinite"


def row(name, point, value, slopes=(NAN,) * 3):
    point = [*point, 0.0, 0.0][:3]
    slopes = [*slopes, NAN, NAN][:3]
    numbers = ", ".join(map(literal, point)), literal(value), ", ".join(map(literal, slopes))
    return "    {{Op::{}, {{{}}}, {}, {{{}}}}},".format(name, *numbers)


def rows():
    for name, (function, points) in [*SMOOTH.items(), *PIECEWISE.items()]:
        for point in (p if isinstance(p, tuple) else (p,) for p in points):
            exact = [mp.mpf(x) for x in point]
            order = np.eye(len(point), dtype=int)
            slopes = [mp.diff(function, tuple(exact), tuple(n)) for n in order]
            yield row(name, point, function(*exact), slopes)
    for name, (function, points) in RULES.items():
        for point in (p if isinstance(p, tuple) else (p,) for p in points):
            yield row(name, point, function(*point))


HEAD = """\
// What the operations of a tape mean, as other programs say it: written by operation_values.py.
#pragma once

#include <limits>

#include "saltus/tape/operation.hpp"

namespace support {

struct OperationValue {
  saltus::tape::Op op;
  double operands[3], value;
  double slopes[3];  ///< by each operand; NaN where none is stored
};

namespace operation_values {

using saltus::tape::Op;
inline constexpr double none = std::numeric_limits<double>::quiet_NaN();
inline constexpr double infinite = std::numeric_limits<double>::infinity();

// clang-format off
inline constexpr OperationValue all[] = {
"""
FOOT = """\
};
// clang-format on

}  // namespace operation_values

}  // namespace support
"""

if __name__ == "__main__":
    np.seterr(all="ignore")
    text = HEAD + "\n".join(rows()) + "\n" + FOOT
    Path(__file__).with_suffix(".hpp").write_text(text)
