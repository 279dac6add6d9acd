"""Many runs of a system whose values differ: `saltus.sweep`."""

from saltus.ensemble.sweep import sweep

__all__ = ["sweep"]
