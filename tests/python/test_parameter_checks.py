"""Parameters in a context: a block refuses the same values as its constructor does."""

import numpy as np
import pytest
import saltus
from saltus import library
from saltus.errors import BlockParameterError, ModelError
from systems import run

LIMITS = {"lower_limit": -1.0, "upper_limit": 1.0}
CASES = {
    "Backlash": ((1.0,), {}, {"width": 0.0}),
    "DeadZone": ((), {"half_range": [1.0, 2.0]}, {"half_range": [1.0, -2.0]}),
    "Derivative": ((), {}, {"filter_coefficient": 0.0}),
    "DerivativeDiscrete": ((0.1,), {"filter_coefficient": 10.0}, {"filter_coefficient": -1.0}),
    "Integrator": ((0.0,), {"enable_limits": True, **LIMITS}, {"lower_limit": 2.0}),
    "IntegratorDiscrete": ((0.1,), {"enable_limits": True, **LIMITS}, {"upper_limit": -2.0}),
    "MassWithFriction mass": ((), {}, {"mass": 0.0}),
    "MassWithFriction coulomb": ((), {}, {"coulomb": -1.0}),
    "MassWithFriction viscous": ((), {}, {"viscous": -1.0}),
    "MassWithFriction static": ((), {}, {"coulomb": 2.0, "static": 1.0}),
    "PID n": ((), {}, {"n": 0.0}),
    "PID limits": ((), LIMITS, {"lower_limit": 1.0}),
    "PID band": ((), LIMITS, {"band": 0.0}),
    "PIDDiscrete n": ((0.1,), {}, {"n": -1.0}),
    "PIDDiscrete limits": ((0.1,), LIMITS, {"upper_limit": -1.0}),
    "Quantizer interval": ((0.5,), {}, {"interval": 0.0}),
    "Quantizer hysteresis": ((0.5,), {"hysteresis": 0.1}, {"hysteresis": 0.5}),
    "RandomNumber deviation": ((0.1,), {}, {"standard_deviation": -1.0}),
    "RandomNumber limits": ((0.1,), {"distribution": "uniform"}, {"lower_limit": 5.0}),
    "RateLimiter": ((0.1,), LIMITS, {"lower_limit": 2.0}),
    "Relay": ((), {"on_threshold": 1.0, "off_threshold": 0.0}, {"on_threshold": -1.0}),
    "Saturate": ((), LIMITS, {"upper_limit": -2.0}),
    "SecondOrderIntegrator limits": ((), LIMITS, {"lower_limit": 2.0}),
    "SecondOrderIntegrator restitution": ((), LIMITS, {"restitution": 2.0}),
    "SecondOrderIntegrator speed": (
        (),
        {"lower_velocity_limit": -1.0, "upper_velocity_limit": 1.0},
        {"upper_velocity_limit": -2.0},
    ),
    "SlewRateLimiter lag": ((), LIMITS, {"time_constant": 0.0}),
    "SlewRateLimiter limits": ((), LIMITS, {"lower_limit": 0.5}),
    "WhiteNoise": ((0.1,), {}, {"power": -1.0}),
}


def made(case):
    arguments, options, bad = CASES[case]
    block = getattr(library, case.split()[0])(*arguments, **options, name="block")
    for port in block.input_ports:
        port.fix_value(np.zeros(port.size) if getattr(port, "size", 1) > 1 else 0.0)
    return block, bad


def refused(message, bad, path):
    assert f"block '{path}'" in message and "expected" in message
    assert any(name.split("_")[0] in message for name in bad)


@pytest.mark.parametrize("case", CASES)
def test_a_run_refuses_what_the_constructor_refuses(case):
    block, bad = made(case)
    good = block.create_context()
    assert run(block, (0.0, 0.2), good).status == "reached_end"
    with pytest.raises(BlockParameterError) as caught:
        run(block, (0.0, 0.2), good.with_parameters(bad))
    refused(str(caught.value), bad, "block")


@pytest.mark.parametrize("case", CASES)
def test_in_a_diagram_it_has_the_path_of_the_block(case):
    block, bad = made(case)
    inner = saltus.DiagramBuilder()
    inner.add(block)
    outer = saltus.DiagramBuilder()
    outer.add(inner.build(name="plant"))
    outer.add(library.Constant(1.0))  # a context of one block needs no paths
    diagram = outer.build()
    context = diagram.create_context()
    for name, value in bad.items():
        context = context.with_parameter(f"plant.block.{name}", value)
    with pytest.raises(BlockParameterError) as caught:
        saltus.simulate(diagram, context, (0.0, 0.2))
    refused(str(caught.value), bad, "plant.block")


def test_a_sweep_keeps_the_reason_and_goes_on():
    block, _ = made("Saturate")
    results = saltus.sweep(block, {"upper_limit": [1.0, -2.0, 2.0]}, (0.0, 0.1), as_dict=True)
    assert results["status"].tolist() == ["reached_end", "failed", "reached_end"]
    assert "expected lower_limit <= upper_limit" in results["message"][1]


def test_a_simulator_goes_on_after_it_refused_a_context():
    block, bad = made("Saturate")
    good = block.create_context()
    simulator = saltus.Simulator(block)
    simulator.initialize(good)
    with pytest.raises(ModelError):
        simulator.initialize(good.with_parameters(bad))
    simulator.initialize(good)
    assert simulator.advance_to(0.1) == "reached_end"


def test_values_without_a_run_refuse_them_too():
    block, bad = made("SlewRateLimiter lag")
    with pytest.raises(BlockParameterError, match="time_constant = 0"):
        block.eval_time_derivatives(block.create_context().with_parameters(bad))
