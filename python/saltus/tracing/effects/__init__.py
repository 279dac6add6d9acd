"""The objects that a called function may write, by its code and the objects that it can reach.

`writes_of(roots)` gives the `Writes` of one callback, `reads_of(roots)` its `Reads`. `Changes`
collects writes, and says which value that a trace was made from may change during a run.
"""

from saltus.tracing.effects.changes import Change, Changes
from saltus.tracing.effects.libraries import only_attributes
from saltus.tracing.effects.looks import Looks
from saltus.tracing.effects.reads import Reads, reads_of
from saltus.tracing.effects.writes import Writes, writes_of

__all__ = [
    "Change",
    "Changes",
    "Looks",
    "Reads",
    "Writes",
    "only_attributes",
    "reads_of",
    "writes_of",
]
