"""Ready blocks. `from saltus.library import *` brings them all.

Where a block takes a value it takes a number or a vector; a number means a vector of equal
entries. Every block takes `name=`; without one it is called after its class and its `system_id`,
such as 'Gain_7'. Values called parameters live in the context, `context.with_parameter("gain.gain",
3.0)`; times, counts and operators are fixed. A switch that reaches a derivative or a reset is
located as an event, and its side is held in between.
"""

from saltus.library.arithmetic import Abs, Adder, Gain, Offset, Product, Saturate
from saltus.library.called import elsewhere
from saltus.library.functions import FeedthroughBlock, FunctionBlock, ReduceBlock, SourceBlock
from saltus.library.logic import Comparator, LogicalOperator, Switch
from saltus.library.sources import Clock, Constant, Pulse, Ramp, Sine, Step
from saltus.library.state import Integrator, UnitDelay, ZeroOrderHold
from saltus.library.vectors import Demultiplexer, Multiplexer

__all__ = [
    "Abs",
    "Adder",
    "Clock",
    "Comparator",
    "Constant",
    "Demultiplexer",
    "FeedthroughBlock",
    "FunctionBlock",
    "Gain",
    "Integrator",
    "LogicalOperator",
    "Multiplexer",
    "Offset",
    "Product",
    "Pulse",
    "Ramp",
    "ReduceBlock",
    "Saturate",
    "Sine",
    "SourceBlock",
    "Step",
    "Switch",
    "UnitDelay",
    "ZeroOrderHold",
]


def __getattr__(name: str) -> None:
    raise elsewhere(name, __all__)
