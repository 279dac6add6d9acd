"""libsbml's own checks of a model: what the specification forbids, and units that do not fit."""

from __future__ import annotations

import warnings
from collections.abc import Iterable, Iterator
from typing import Any

import libsbml

from saltus.errors import ModelError

__all__ = ["require_consistent", "require_no_errors", "warn_of_units"]

GENERAL = libsbml.LIBSBML_CAT_GENERAL_CONSISTENCY
UNITS = libsbml.LIBSBML_CAT_UNITS_CONSISTENCY
RULES = (
    libsbml.LIBSBML_CAT_IDENTIFIER_CONSISTENCY,
    libsbml.LIBSBML_CAT_MATHML_CONSISTENCY,
    libsbml.LIBSBML_CAT_SBO_CONSISTENCY,
    libsbml.LIBSBML_CAT_OVERDETERMINED_MODEL,
)
CATEGORIES = (GENERAL, UNITS, *RULES, libsbml.LIBSBML_CAT_MODELING_PRACTICE)
MOST_RULES = 100
"""Of libsbml's general checks, that for rings takes time as the fourth power of a chain of rules:
0.05 s for a hundred, 10 s for four hundred. Rings are found here in any case."""
INCONSISTENT = range(10500, 10600)
"""numbers of the errors of units that are declared and differ (SBML level 3 version 2, appendix A,
rules 10501 to 10599); units that the model does not declare have other numbers"""
MOST_MESSAGES = 5
HARMLESS = {libsbml.MissingXMLDecl, libsbml.MissingXMLEncoding, libsbml.BadXMLDecl}
"""XML needs no declaration; libsbml asks for one, and reads the file without it"""


def require_no_errors(document: Any, name: str) -> None:
    """ModelError with libsbml's messages, by line, for the errors in its log."""
    found = [
        error
        for error in _log(document)
        if error.getSeverity() >= libsbml.LIBSBML_SEV_ERROR and error.getErrorId() not in HARMLESS
    ]
    if not found:
        return
    more = len(found) - MOST_MESSAGES
    shown = "\n  ".join(map(_line, found[:MOST_MESSAGES]))
    shown += f"\n  and {more} more" if more > 0 else ""
    raise ModelError(f"{name}: libsbml finds errors; correct them:\n  {shown}")


def require_consistent(document: Any, name: str) -> None:
    """ModelError for what the specification forbids; units and style are not checked."""
    model = document.getModel()
    ruled = model.getNumRules() + model.getNumInitialAssignments()
    _check(document, (*RULES, GENERAL) if ruled <= MOST_RULES else RULES)
    require_no_errors(document, name)


def warn_of_units(document: Any, name: str) -> None:
    """One UserWarning for a model whose declared units do not fit. Units change no number here."""
    if not _declares_units(document.getModel()):
        return
    _check(document, (UNITS,))
    found = [_line(error) for error in _log(document) if error.getErrorId() in INCONSISTENT]
    if found:
        more = f" And {len(found) - 1} more." if len(found) > 1 else ""
        warnings.warn(
            f"{name}: units do not fit, {found[0]}{more} Saltus converts no units; correct the "
            "formula if its numbers are in other units than they should be",
            stacklevel=4,  # the caller of load
        )


def _check(document: Any, chosen: Iterable[int]) -> None:
    document.getErrorLog().clearLog()
    for category in CATEGORIES:
        document.setConsistencyChecks(category, category in chosen)
    document.checkConsistency()


def _log(document: Any) -> Iterator[Any]:
    return (document.getError(i) for i in range(document.getNumErrors()))


def _line(error: Any) -> str:
    return f"line {error.getLine()}: {' '.join(error.getMessage().split())}"


def _declares_units(model: Any) -> bool:
    parameters = (model.getParameter(i) for i in range(model.getNumParameters()))
    return model.getNumUnitDefinitions() > 0 or any(each.isSetUnits() for each in parameters)
