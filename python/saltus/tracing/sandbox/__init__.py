"""Copies of the user's functions that read through faces and cannot write outside.

`Sandbox.form_of(function, words)` gives the copy. `Sandbox.dependencies` knows what the copy read:
`Dependencies.changed()` says whether that has changed since.
"""

from saltus.tracing.sandbox.code import names_in
from saltus.tracing.sandbox.dependencies import MISSING, PLAIN, Dependencies, same, same_content
from saltus.tracing.sandbox.glance import Glance
from saltus.tracing.sandbox.sandbox import Sandbox

__all__ = [
    "MISSING",
    "PLAIN",
    "Dependencies",
    "Glance",
    "Sandbox",
    "names_in",
    "same",
    "same_content",
]
