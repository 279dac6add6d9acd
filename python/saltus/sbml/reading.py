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

from saltus.sbml.checks import require_consistent, require_no_errors, warn_of_units

__all__ = ["model_of"]

KNOWN_PACKAGES = ("comp", "l3v2extendedmath")
PICTURES = ("layout", "render")
"""packages that say how a model is drawn; libsbml calls those of level 2 required"""
DEEPEST = 300
"""nested operations of a formula; the walks through one take some frames of Python for each"""


def model_of(source: str | os.PathLike[str]) -> tuple[Any, Any]:
    """(the document, its model) of a file, or of a text that begins with '<'.

    A model keeps its level; submodels are flattened. ModelError for a
    file that is not there, for no XML, for what libsbml calls an error, and for packages and
    elements that have no time course here.
    """
    document, name = _document(source)
    require_no_errors(document, name)
    if document.getModel() is None:
        raise ModelError(f"{name}: expected a <model>, found none")
    _flatten(document, name)
    _require_known_packages(document, name)
    model = document.getModel()
    _require_ordinary(model, name)
    _require_shallow(model, name)
    require_consistent(document, name)
    warn_of_units(document, name)
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


def _require_shallow(model: Any, name: str) -> None:
    """No formula that is nested deeper than the walks through it may be."""
    elements = model.getListOfAllElements()
    for i in range(elements.getSize()):
        each = elements.get(i)
        tree = each.getMath() if hasattr(each, "getMath") else None
        if tree is not None and _deeper(tree, DEEPEST):
            label = each.getElementName() + (f" '{each.getId()}'" if each.getId() else "")
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
