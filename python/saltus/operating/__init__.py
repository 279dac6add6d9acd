"""Operating points of systems: states at which chosen rates and outputs have chosen values."""

from saltus.operating.equilibria import Equilibria, equilibria
from saltus.operating.point import OperatingPoint
from saltus.operating.trim import trim

__all__ = ["Equilibria", "OperatingPoint", "equilibria", "trim"]
