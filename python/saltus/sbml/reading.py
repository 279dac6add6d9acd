"""A model in SBML, read and checked by libsbml."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

from saltus.errors import ModelError

try:
    import libsbml
except ImportError:
    raise ModelError(
        "a model in SBML is read by python-libsbml, which is not installed; "
        "install it: pip install 'saltus[sbml]'"
    ) from None

__all__ = ["model_of"]

KNOWN_PACKAGES = ("comp", "l3v2extendedmath")
PICTURES = ("layout", "render")
"""packages that say how a model is drawn; libsbml calls those of level 2 required"""
MOST_MESSAGES = 5
DEEPEST = 300
"""nested operations of a formula; the walks through one take some frames of Python for each"""
UNCHECKED = (libsbml.LIBSBML_CAT_UNITS_CONSISTENCY, libsbml.LIBSBML_CAT_MODELING_PRACTICE)
MOST_RULES = 100
"""Of libsbml's general checks, that for rings takes time as the fourth power of a chain of rules:
0.05 s for a hundred, 10 s for four hundred. Rings are found here in any case."""
HARMLESS = {libsbml.MissingXMLDecl, libsbml.MissingXMLEncoding, libsbml.BadXMLDecl}
"""XML needs no declaration; libsbml asks for one, and reads the file without it"""


def model_of(source: str | os.PathLike[str]) -> tuple[Any, Any]:
    """(the document, its model) of a file, or of a text that begins with '<'.

    Models of level 1 and 2 are converted to level 3; submodels are flattened. ModelError for a
    file that is not there, for no XML, for what libsbml calls an error, and for packages and
    elements that have no time course here.
    """
    document, name = _document(source)
    _require_no_errors(document, name)
    if document.getModel() is None:
        raise ModelError(f"{name}: expected a <model>, found none")
    _flatten(document, name)
    _require_known_packages(document, name)
    model = document.getModel()
    _require_ordinary(model, name)
    _require_shallow(model, name)
    _require_consistent(document, name)
    return document, model


def _document(source: str | os.PathLike[str]) -> tuple[Any, str]:
    if not isinstance(source, (str, os.PathLike)) or not str(source).strip():
        raise ModelError(
            "expected the path of a model in SBML, or its text as a str with '<' first, found "
            f"{'an empty text' if isinstance(source, str) else type(source).__name__}"
        )
    if isinstance(source, str) and source.lstrip("\ufeff \t\r\n").startswith("<"):
        return libsbml.readSBMLFromString(source.lstrip("\ufeff \t\r\n")), "SBML"
    path = Path(source)
    if not path.is_file():
        raise ModelError(f"there is no file '{path}'; expected a model in SBML, or its text")
    return libsbml.readSBMLFromFile(str(path)), str(path)


def _require_no_errors(document: Any, name: str) -> None:
    """libsbml's own messages, by line."""
    log = (document.getError(i) for i in range(document.getNumErrors()))
    found = [
        error
        for error in log
        if error.getSeverity() >= libsbml.LIBSBML_SEV_ERROR and error.getErrorId() not in HARMLESS
    ]
    if not found:
        return
    lines = [f"line {e.getLine()}: {' '.join(e.getMessage().split())}" for e in found]
    more = len(lines) - MOST_MESSAGES
    shown = "\n  ".join(lines[:MOST_MESSAGES]) + (f"\n  and {more} more" if more > 0 else "")
    raise ModelError(f"{name}: libsbml finds errors; correct them:\n  {shown}")


def _require_consistent(document: Any, name: str) -> None:
    """What the specification forbids, as libsbml checks it; units and style are not checked."""
    document.getErrorLog().clearLog()
    model = document.getModel()
    ruled = model.getNumRules() + model.getNumInitialAssignments()
    general = () if ruled <= MOST_RULES else (libsbml.LIBSBML_CAT_GENERAL_CONSISTENCY,)
    for kind in (*UNCHECKED, *general):
        document.setConsistencyChecks(kind, False)
    document.checkConsistency()
    _require_no_errors(document, name)


def _require_shallow(model: Any, name: str) -> None:
    """No formula that is nested deeper than the walks through it may be."""
    elements = model.getListOfAllElements()
    for i in range(elements.getSize()):
        each = elements.get(i)
        tree = each.getMath() if hasattr(each, "getMath") else None
        if tree is not None and _deeper(tree, DEEPEST):
            label = (
                f"{each.getElementName()} '{each.getId()}'"
                if each.getId()
                else (f"{each.getElementName()}")
            )
            raise ModelError(
                f"{name}: line {each.getLine()}: {label}: expected a formula of at most {DEEPEST} "
                "nested operations, found a deeper one; write a long sum or product as one "
                "operation of many operands, or name its parts by assignment rules"
            )


def _deeper(tree: Any, most: int) -> bool:
    level = [tree]
    for _ in range(most):
        level = [each.getChild(i) for each in level for i in range(each.getNumChildren())]
        if not level:
            return False
    return True


def _flatten(document: Any, name: str) -> None:
    if document.getPlugin("comp") is None:
        return
    properties = libsbml.ConversionProperties()
    properties.addOption("flatten comp", True)
    properties.addOption("performValidation", False)
    if document.convert(properties) != libsbml.LIBSBML_OPERATION_SUCCESS:
        reasons = [
            " ".join(document.getError(i).getMessage().split())
            for i in range(document.getNumErrors())
        ]
        raise ModelError(f"{name}: libsbml cannot flatten its submodels: {'; '.join(reasons[:3])}")


def _require_known_packages(document: Any, name: str) -> None:
    for i in range(document.getNumPlugins()):
        package = document.getPlugin(i).getPackageName()
        required = document.getPackageRequired(package)
        if package in PICTURES or package in KNOWN_PACKAGES:
            continue
        if required or package == "fbc":
            raise ModelError(
                f"{name}: package '{package}' is not supported; a model of core SBML and of 'comp' "
                "has a time course here"
            )


def _require_ordinary(model: Any, name: str) -> None:
    for i in range(model.getNumReactions()):
        reaction = model.getReaction(i)
        if reaction.isSetFast() and reaction.getFast():
            raise ModelError(
                f"{name}: reaction '{reaction.getId()}' is fast, which is not supported; give it a "
                "rate that is large against the others, or an algebraic rule in its place"
            )
