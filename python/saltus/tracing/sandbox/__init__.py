"""Copies of the user's functions that read through faces, are watched, and cannot write outside.

`Sandbox.form_of(function, words)` gives the copy. `Sandbox.watch` knows what the copy read:
`Watch.changed()` says whether that has changed since.
"""

from saltus.tracing.sandbox.code import names_in
from saltus.tracing.sandbox.glance import Glance
from saltus.tracing.sandbox.sandbox import Sandbox
from saltus.tracing.sandbox.watch import MISSING, PLAIN, Watch, same, same_content

__all__ = ["MISSING", "PLAIN", "Glance", "Sandbox", "Watch", "names_in", "same", "same_content"]
