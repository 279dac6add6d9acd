"""Tracing: an unchanged Python callback is called once with symbols and becomes a tape.

`trace(Signature(...))` gives `Traced` or `Refused`. The tape runs without interpreter, has an exact
Jacobian, and smooth guards where a result is made of comparisons. See the README beside this file.
"""

from saltus.tracing.known import Known
from saltus.tracing.readers import readers_of_writes
from saltus.tracing.residuals import as_guard
from saltus.tracing.sandbox import Dependencies, Glance
from saltus.tracing.sharing import Sharing, sharing_of
from saltus.tracing.siblings import Siblings
from saltus.tracing.signature import Refused, Relations, Signature, Traced
from saltus.tracing.tracing import trace

__all__ = [
    "Dependencies",
    "Glance",
    "Known",
    "Refused",
    "Relations",
    "Sharing",
    "Siblings",
    "Signature",
    "Traced",
    "as_guard",
    "readers_of_writes",
    "sharing_of",
    "trace",
]
