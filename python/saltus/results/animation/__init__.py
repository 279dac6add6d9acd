"""Films of runs."""

from saltus.results.animation.animation import Animation, animate
from saltus.results.animation.film import Film, Moment

__all__ = ["Animation", "Film", "Moment", "animate"]
