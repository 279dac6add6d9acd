"""The results of a run."""

from saltus.results.events import Event, EventLog
from saltus.results.outcome import Results
from saltus.results.saving import load_results
from saltus.results.sensitivities import Gap, Sensitivities
from saltus.results.statistics import Statistics
from saltus.results.values import Values

__all__ = [
    "Event",
    "EventLog",
    "Gap",
    "Results",
    "Sensitivities",
    "Statistics",
    "Values",
    "load_results",
]
