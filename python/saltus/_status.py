"""The statuses of a run that ended as its user asked."""

__all__ = ["WELL"]

WELL = ("reached_end", "terminal", "zeno_stop")
