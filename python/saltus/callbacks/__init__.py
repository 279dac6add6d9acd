"""How each Python callback of a system runs: called, traced or compiled, and why."""

from saltus.callbacks.callbacks import Callbacks
from saltus.callbacks.explanation import ExplainedCallback, Explanation
from saltus.callbacks.planned import called_callbacks, explain, planned, traced_callbacks

__all__ = [
    "Callbacks",
    "ExplainedCallback",
    "Explanation",
    "called_callbacks",
    "explain",
    "planned",
    "traced_callbacks",
]
