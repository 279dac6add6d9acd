"""The words of an expression: functions and constants."""

from __future__ import annotations

import math

__all__ = ["CONSTANTS", "FUNCTIONS", "ON_ZENO", "RESERVED"]

FUNCTIONS = {
    "abs": ("abs", 1),
    "acos": ("arccos", 1),
    "acosh": ("arccosh", 1),
    "asin": ("arcsin", 1),
    "asinh": ("arcsinh", 1),
    "atan": ("arctan", 1),
    "atan2": ("arctan2", 2),
    "atanh": ("arctanh", 1),
    "cbrt": ("cbrt", 1),
    "ceil": ("ceil", 1),
    "clip": ("clip", 3),
    "cos": ("cos", 1),
    "cosh": ("cosh", 1),
    "exp": ("exp", 1),
    "expm1": ("expm1", 1),
    "floor": ("floor", 1),
    "hypot": ("hypot", 2),
    "interp": ("interp", 3),
    "log": ("log", 1),
    "log10": ("log10", 1),
    "log1p": ("log1p", 1),
    "log2": ("log2", 1),
    "max": ("maximum", None),
    "min": ("minimum", None),
    "round": ("round", 1),
    "sign": ("sign", 1),
    "sin": ("sin", 1),
    "sinh": ("sinh", 1),
    "sqrt": ("sqrt", 1),
    "tan": ("tan", 1),
    "tanh": ("tanh", 1),
    "where": ("where", 3),
}
"""name -> (function of numpy, how many arguments; None: two or more, taken two by two)"""

CONSTANTS = {"inf": math.inf, "pi": math.pi}

RESERVED = {"t", "time", "state", "mode", *CONSTANTS}
"""names that no state, input or parameter may have; one may share its name with a function, which
is always followed by '('
"""

ON_ZENO = {"hold", "stop", "error"}
"""the choices for a guard at its Zeno point, besides the name of a mode"""
