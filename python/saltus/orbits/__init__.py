"""Periodic orbits of hybrid systems, and maps over one period."""

from saltus.orbits.find_orbit import periodic_orbit
from saltus.orbits.linear_map import PeriodMap
from saltus.orbits.orbit import PeriodicOrbit
from saltus.orbits.period_map import period_map

__all__ = ["PeriodMap", "PeriodicOrbit", "period_map", "periodic_orbit"]
