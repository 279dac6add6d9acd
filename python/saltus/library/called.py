"""Names of blocks in other tools, and the advice for each."""

from __future__ import annotations

from collections.abc import Iterable

from saltus._core import known_names

__all__ = ["elsewhere"]

CALLED_HERE = {
    "Adder": "Add MultiSum Subtract Sum",
    "Chirp": "ChirpSignal SineVariableFrequencyAndAmplitude",
    "Clock": "ContinuousClock",
    "Comparator": "CompareToConstant Less Relational RelationalOperator",
    "Constant": "ConstantVectorSource",
    "DataSource": "CombiTimeTable FromWorkspace SignalEditor TrajectorySource",
    "DelayN": "Delay DiscreteTimeDelay",
    "Demultiplexer": "DeMultiplex Demux",
    "DerivativeDiscrete": "DiscreteDerivative",
    "DiscreteClock": "DigitalClock",
    "EdgeDetection": "DetectRisePositive Edge EdgeDetector",
    "EnabledSubsystem": "Enable",
    "Exponent": "Exp Math MathFunction",
    "FilterDiscrete": "DiscreteFIRFilter",
    "FunctionBlock": "Fcn MATLABFunction SymbolicVectorSystem",
    "HitCrossing": "ZeroCrossing",
    "IfThenElse": "If",
    "Integrator": "LimIntegrator",
    "IntegratorDiscrete": "DiscreteIntegrator DiscreteTimeIntegrator",
    "LTISystem": "LinearSystem StateSpace",
    "LTISystemDiscrete": "DiscreteStateSpace LinearSystem StateSpace",
    "Logarithm": "Log Log10 Math MathFunction",
    "LogicalOperator": "And Logic",
    "LookupTable1d": "CombiTable1Ds",
    "LookupTable2d": "CombiTable2Ds",
    "LookupTableNd": "LookupTableND nDLookupTable",
    "MassWithFriction": "CoulombFriction Friction MassWithStopAndFriction",
    "MatrixConcatenation": "MatrixConcatenate Stack VectorConcatenate",
    "MatrixInversion": "MatrixInverse",
    "MatrixMultiplication": "MatrixMultiply",
    "MatrixTransposition": "Transpose",
    "MinMax": "Max Min",
    "Multiplexer": "Multiplex Mux",
    "MultiportSwitch": "Extractor PortSwitch",
    "Offset": "Bias",
    "PID": "LimPID PIDController PidController",
    "PIDDiscrete": "DiscretePID DiscretePIDController",
    "Power": "Math MathFunction",
    "Product": "Divide Division",
    "ProductOfElements": "MultiProduct ProductofElements",
    "Pulse": "PulseGenerator PulseTrain",
    "Ramp": "TrajectorySource",
    "RandomNumber": "NormalNoise RandomSource UniformNoise UniformRandomNumber",
    "RateTransition": "Sampler",
    "Reciprocal": "Division Math MathFunction",
    "ReduceBlock": "MATLABFcn MATLABFunction MatlabFunction SymbolicVectorSystem",
    "Relay": "Hysteresis",
    "RigidBody": "Body",
    "Saturate": "Limiter Saturation",
    "Sawtooth": "RepeatingSequence SawTooth",
    "ScalarBroadcast": "Replicator",
    "Sine": "SineWave",
    "Slice": "Extractor Selector",
    "SquareRoot": "Sqrt",
    "StateMachine": "Chart StateGraph",
    "Stop": "StopSimulation TerminateSimulation",
    "SumOfElements": "SumofElements",
    "TransferFunction": "TransferFcn",
    "TransferFunctionDiscrete": "DiscreteFilter DiscreteTransferFcn DiscreteTransferFunction",
    "TransportDelay": "FixedDelay",
    "TriggeredSubsystem": "Trigger",
    "Trigonometric": "Sin TrigonometricFunction",
    "WhiteNoise": "BandLimitedWhiteNoise",
    "ZeroOrderHold": "SampleAndHold",
}
"""block -> what Simulink, Modelica, Drake and pycollimator call it"""
DONE = {
    "LogicalReduce": "all of them are ProductOfElements, any of them is SumOfElements, of truths",
    "Memory": "a UnitDelay has a period; without one, a held state is one of a LeafSystem",
    "Merge": "a Switch or a MultiportSwitch chooses among the outputs",
    "SignalDatatypeConversion": "every value is a double; leave it out",
    "VariableTransportDelay": "the delay of a TransportDelay is a fixed number",
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
    here = [block for block, names in CALLED_HERE.items() if name in names.split()]
    if here:
        return ImportError(f"saltus.library has no '{name}'; it is called {' or '.join(here)} here")
    if name in DONE:
        return ImportError(f"saltus.library has no '{name}'; {DONE[name]}")
    found = "" if name.startswith("_") else known_names(name, sorted(known))
    return AttributeError(f"module 'saltus.library' has no attribute '{name}'{found}")
