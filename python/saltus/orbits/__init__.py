"""Periodic orbits of hybrid systems."""

from saltus.orbits.find_orbit import periodic_orbit
from saltus.orbits.orbit import PeriodicOrbit

__all__ = ["PeriodicOrbit", "periodic_orbit"]
