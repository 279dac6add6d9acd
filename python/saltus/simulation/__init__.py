"""Runs of a system: whole, or in pieces."""

from saltus.options import SimulatorOptions
from saltus.results import Results
from saltus.simulation.simulate import simulate
from saltus.simulation.simulator import Simulator

__all__ = ["Results", "Simulator", "SimulatorOptions", "simulate"]
