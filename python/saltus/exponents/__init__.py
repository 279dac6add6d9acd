"""Lyapunov exponents of systems with events."""

from saltus.exponents.lyapunov import lyapunov
from saltus.exponents.spectrum import LyapunovSpectrum

__all__ = ["LyapunovSpectrum", "lyapunov"]
