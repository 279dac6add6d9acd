"""Names of blocks in other tools, and the advice for each."""

from __future__ import annotations

from collections.abc import Iterable

from saltus._core import known_names

__all__ = ["elsewhere"]

CALLED = {
    "Add": "Adder",
    "BandLimitedWhiteNoise": "WhiteNoise",
    "Bias": "Offset",
    "Chart": "StateMachine",
    "CombiTimeTable": "DataSource",
    "Delay": "DelayN",
    "Demux": "Demultiplexer",
    "DigitalClock": "DiscreteClock",
    "DiscreteDerivative": "DerivativeDiscrete",
    "DiscreteFIRFilter": "FilterDiscrete",
    "DiscreteFilter": "TransferFunctionDiscrete",
    "DiscreteIntegrator": "IntegratorDiscrete",
    "DiscretePID": "PIDDiscrete",
    "DiscreteStateSpace": "LTISystemDiscrete",
    "DiscreteTimeDelay": "DelayN",
    "DiscreteTimeIntegrator": "IntegratorDiscrete",
    "DiscreteTransferFcn": "TransferFunctionDiscrete",
    "DiscreteTransferFunction": "TransferFunctionDiscrete",
    "Divide": "Product",
    "Enable": "EnabledSubsystem",
    "Fcn": "FunctionBlock",
    "FixedDelay": "TransportDelay",
    "FromWorkspace": "DataSource",
    "Logic": "LogicalOperator",
    "LookupTableND": "LookupTableNd",
    "MATLABFcn": "ReduceBlock",
    "MatlabFunction": "ReduceBlock",
    "Mux": "Multiplexer",
    "PulseGenerator": "Pulse",
    "PulseTrain": "Pulse",
    "RandomSource": "RandomNumber",
    "Relational": "Comparator",
    "RelationalOperator": "Comparator",
    "RepeatingSequence": "Sawtooth",
    "Saturation": "Saturate",
    "SineWave": "Sine",
    "Subtract": "Adder",
    "Sum": "Adder",
    "Trigger": "TriggeredSubsystem",
    "UniformRandomNumber": "RandomNumber",
}
"""names of blocks in Simulink, Modelica and Drake"""
DONE = {
    "Display": "record the signal: simulate(..., recorded_signals={...})",
    "From": "connect the output where the Goto block begins",
    "Goto": "an output may be connected to many inputs",
    "Ground": "give the input a fixed value: port.fix_value(0.0)",
    "Inport": "builder.export_input",
    "LogVectorOutput": "record the signal: simulate(..., recorded_signals={...})",
    "Outport": "builder.export_output",
    "Scope": "record the signal: simulate(..., recorded_signals={...}), then results.plot()",
    "Subsystem": "a diagram: DiagramBuilder",
    "Terminator": "leave it out: an output may be unconnected",
    "ToWorkspace": "record the signal: simulate(..., recorded_signals={...})",
}
"""names for which the library has no block"""


def elsewhere(name: str, known: Iterable[str]) -> AttributeError | ImportError:
    """The error for a block that the library does not have.

    `from saltus.library import Sum` would replace an AttributeError, and with it the advice. The
    price is that `hasattr` of one of these names raises.
    """
    if name in CALLED:
        return ImportError(f"saltus.library has no '{name}'; it is called {CALLED[name]} here")
    if name in DONE:
        return ImportError(f"saltus.library has no '{name}'; {DONE[name]}")
    found = "" if name.startswith("_") else known_names(name, sorted(known))
    return AttributeError(f"module 'saltus.library' has no attribute '{name}'{found}")
