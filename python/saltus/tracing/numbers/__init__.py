"""Numbers that are not known yet, arrays of them, and numpy's functions on them.

`Symbol` is one number, a node of an expression graph; `SymbolArray` is an array of known numbers
and symbols. `apply` computes an operation entry by entry, `call_ufunc` and `call_function` are
numpy's functions. Nothing here knows of the functions that are traced.
"""

from saltus.tracing.numbers.arrays import SymbolArray, array, as_array, kind_of_type
from saltus.tracing.numbers.entrywise import apply
from saltus.tracing.numbers.functions import call_function, has_symbols, owned, plain
from saltus.tracing.numbers.operators import ON_ARRAYS, ON_BOTH, ON_SYMBOLS
from saltus.tracing.numbers.scalars import NUMPY, SCALARS, is_number, truth, whole
from saltus.tracing.numbers.symbol import Symbol, kind_of
from saltus.tracing.numbers.ufuncs import call_ufunc, reduce_ufunc

__all__ = [
    "NUMPY", "ON_ARRAYS", "ON_BOTH", "ON_SYMBOLS", "SCALARS", "Symbol", "SymbolArray", "apply",
    "array", "as_array", "call_function", "call_ufunc", "has_symbols", "is_number", "kind_of",
    "kind_of_type", "owned", "plain", "reduce_ufunc", "truth", "whole",
]  # fmt: skip
