"""Ready blocks. `from saltus.library import *` brings them all.

A value of a block is a number, a vector or a matrix; a number means equal entries. Every block
takes `name=`; without it the name is made of its class and its `system_id`, such as 'Gain_7'.
Values called parameters live in the context, `context.with_parameter("gain.gain", 3.0)`; times,
counts and operators are fixed. A switch that reaches a derivative or a reset is located as an
event, and its side is held in between.
"""

from saltus.library.arithmetic import Abs, Adder, Gain, Offset, Product, Saturate
from saltus.library.buses import BusCreator, BusSelector
from saltus.library.delays import DelayN, TransportDelay, UnitDelay
from saltus.library.discrete import (
    DiscreteClock,
    EdgeDetection,
    RateLimiter,
    RateTransition,
    ZeroOrderHold,
)
from saltus.library.discrete_control import DerivativeDiscrete, IntegratorDiscrete, PIDDiscrete
from saltus.library.discrete_linear import (
    FilterDiscrete,
    LTISystemDiscrete,
    TransferFunctionDiscrete,
)
from saltus.library.functions import FeedthroughBlock, FunctionBlock, ReduceBlock, SourceBlock
from saltus.library.linear import PID, Derivative, LTISystem, TransferFunction
from saltus.library.logic import (
    Comparator,
    Counter,
    HitCrossing,
    IfThenElse,
    LogicalOperator,
    MultiportSwitch,
    Relay,
    Stop,
    Switch,
)
from saltus.library.lookup_tables import LookupTable1d, LookupTable2d, LookupTableNd
from saltus.library.maps import Exponent, Logarithm, Power, Reciprocal, SquareRoot, Trigonometric
from saltus.library.matrices import (
    MatrixConcatenation,
    MatrixInversion,
    MatrixMultiplication,
    MatrixTransposition,
    Reshape,
)
from saltus.library.mechanics import Backlash, MassWithFriction, RigidBody
from saltus.library.noise import RandomNumber, WhiteNoise
from saltus.library.nonlinear import DeadZone, MinMax, Quantizer, Sign
from saltus.library.signals import Chirp, DataSource, Sawtooth
from saltus.library.sources import Clock, Constant, Pulse, Ramp, Sine, Step
from saltus.library.state import Integrator, SecondOrderIntegrator, SlewRateLimiter
from saltus.library.state_machine import StateMachine, Transition
from saltus.library.subsystems import (
    ControlPort,
    EnabledSubsystem,
    SubsystemOutput,
    TriggeredSubsystem,
)
from saltus.library.vectors import (
    CrossProduct,
    Demultiplexer,
    DotProduct,
    Multiplexer,
    ProductOfElements,
    ScalarBroadcast,
    Slice,
    SumOfElements,
)

__all__ = [
    "PID",
    "Abs",
    "Adder",
    "Backlash",
    "BusCreator",
    "BusSelector",
    "Chirp",
    "Clock",
    "Comparator",
    "Constant",
    "ControlPort",
    "Counter",
    "CrossProduct",
    "DataSource",
    "DeadZone",
    "DelayN",
    "Demultiplexer",
    "Derivative",
    "DerivativeDiscrete",
    "DiscreteClock",
    "DotProduct",
    "EdgeDetection",
    "EnabledSubsystem",
    "Exponent",
    "FeedthroughBlock",
    "FilterDiscrete",
    "FunctionBlock",
    "Gain",
    "HitCrossing",
    "IfThenElse",
    "Integrator",
    "IntegratorDiscrete",
    "LTISystem",
    "LTISystemDiscrete",
    "Logarithm",
    "LogicalOperator",
    "LookupTable1d",
    "LookupTable2d",
    "LookupTableNd",
    "MassWithFriction",
    "MatrixConcatenation",
    "MatrixInversion",
    "MatrixMultiplication",
    "MatrixTransposition",
    "MinMax",
    "Multiplexer",
    "MultiportSwitch",
    "Offset",
    "PIDDiscrete",
    "Power",
    "Product",
    "ProductOfElements",
    "Pulse",
    "Quantizer",
    "Ramp",
    "RandomNumber",
    "RateLimiter",
    "RateTransition",
    "Reciprocal",
    "ReduceBlock",
    "Relay",
    "Reshape",
    "RigidBody",
    "Saturate",
    "Sawtooth",
    "ScalarBroadcast",
    "SecondOrderIntegrator",
    "Sign",
    "Sine",
    "SlewRateLimiter",
    "Slice",
    "SourceBlock",
    "SquareRoot",
    "StateMachine",
    "Step",
    "Stop",
    "SubsystemOutput",
    "SumOfElements",
    "Switch",
    "TransferFunction",
    "TransferFunctionDiscrete",
    "Transition",
    "TransportDelay",
    "TriggeredSubsystem",
    "Trigonometric",
    "UnitDelay",
    "WhiteNoise",
    "ZeroOrderHold",
]


def __getattr__(name: str) -> None:
    from saltus.library.called import elsewhere

    raise elsewhere(name, __all__)
