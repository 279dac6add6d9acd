"""The results of a run."""

from saltus.results.events import Event, EventLog
from saltus.results.outcome import Results
from saltus.results.saving import load_results
from saltus.results.statistics import Statistics
from saltus.results.values import Values

__all__ = ["Event", "EventLog", "Results", "Statistics", "Values", "load_results"]
