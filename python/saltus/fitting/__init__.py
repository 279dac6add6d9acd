"""Parameters of a system from measured data: `saltus.fit`."""

from saltus.fitting.experiment import EventTimes, Experiment
from saltus.fitting.fit import fit
from saltus.fitting.free import Free
from saltus.fitting.progress import FitProgress
from saltus.fitting.result import FitResult

__all__ = ["EventTimes", "Experiment", "FitProgress", "FitResult", "Free", "fit"]
