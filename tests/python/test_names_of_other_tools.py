"""Names of other tools: each block name has an answer, each argument of pycollimator's blocks too."""

import re
import sys
from pathlib import Path

import numpy as np
import pytest
import saltus
import saltus.library as library
from saltus.library import (
    PID,
    Adder,
    Clock,
    Comparator,
    DataSource,
    Demultiplexer,
    DerivativeDiscrete,
    DiscreteClock,
    EdgeDetection,
    FeedthroughBlock,
    Gain,
    Integrator,
    LookupTable2d,
    LTISystem,
    LTISystemDiscrete,
    MatrixConcatenation,
    MatrixMultiplication,
    MinMax,
    Multiplexer,
    PIDDiscrete,
    Product,
    Pulse,
    RandomNumber,
    RateLimiter,
    ReduceBlock,
    RigidBody,
    Saturate,
    ScalarBroadcast,
    Slice,
    SourceBlock,
    StateMachine,
    WhiteNoise,
)

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "docs" / "site"))

import names  # noqa: E402


def words_of(name):
    """The ways to write a name of the table as one word."""
    plain = re.sub(r"\(.*?\)", "", name.strip("`")).strip()
    spaced = plain.replace(" ", "").replace("-", "")
    found = {plain, spaced, plain.split(".")[-1]}
    return {word for word in found if re.fullmatch(r"[A-Za-z]\w*", word)}


def table():
    """{name in another tool: names here} of the blocks in docs/blocks.md."""
    found = {}
    for name, _, here in names.of_blocks((ROOT / "docs" / "blocks.md").read_text()):
        for word in words_of(name):
            if word not in library.__all__:
                found.setdefault(word, set()).add(here.strip("`"))
    return found


PORTS = {"Enable": "EnabledSubsystem", "Trigger": "TriggeredSubsystem", "Outport": "export_output"}
"""blocks that are ports of a subsystem there -> what makes them here"""


@pytest.mark.parametrize(("name", "here"), table().items())
def test_a_block_of_another_tool_is_answered_with_its_name_here(name, here):
    with pytest.raises((ImportError, AttributeError)) as caught:
        getattr(library, name)
    expected = {PORTS[name]} if name in PORTS else here
    assert any(one in str(caught.value) for one in expected), str(caught.value)


def test_the_table_is_read():
    assert len(table()) > 80 and "Adder" in table()["Sum"]


A, B = [[0.5]], [[1.0]]
ALIKE = {
    "Multiplexer": (Multiplexer(n_in=2), Multiplexer(2), (1.0, 2.0)),
    "Demultiplexer": (Demultiplexer(n_out=2), Demultiplexer(2), ([1.0, 2.0],)),
    "MinMax": (MinMax(n_in=2, operator="max"), MinMax("max"), (1.0, 2.0)),
    "MinMax by position": (MinMax(2, "max"), MinMax("max"), (1.0, 2.0)),
    "MatrixMultiplication": (MatrixMultiplication(n_in=2), MatrixMultiplication(), (A, B)),
    "MatrixMultiplication by position": (MatrixMultiplication(2), MatrixMultiplication(), (A, B)),
    "MatrixConcatenation": (
        MatrixConcatenation(n_in=2, axis=1), MatrixConcatenation(2, 1), (A, B),
    ),
    "FeedthroughBlock": (
        FeedthroughBlock(func=lambda u: 2 * u, parameters={}),
        FeedthroughBlock(lambda u: 2 * u), (3.0,),
    ),
    "ReduceBlock": (
        ReduceBlock(n_in=2, op=lambda u: u[0] - u[1]), ReduceBlock(2, lambda u: u[0] - u[1]),
        (3.0, 1.0),
    ),
    "SourceBlock": (SourceBlock(func=lambda t: 2 * t), SourceBlock(lambda t: 2 * t), ()),
    "LookupTable2d": (
        LookupTable2d(
            input_x_array=[0, 1], input_y_array=[0, 2], output_table_array=[[0, 1], [2, 3]],
            interpolation="linear",
        ),
        LookupTable2d([0, 1], [0, 2], [[0, 1], [2, 3]]), (0.5, 0.5),
    ),
    "EdgeDetection": (
        EdgeDetection(0.1, edge_detection="either"), EdgeDetection(0.1, "either"), (True,),
    ),
    "DerivativeDiscrete": (
        DerivativeDiscrete(0.1, filter_type="backward", filter_coefficient=2.0),
        DerivativeDiscrete(0.1, 2.0), (Clock(),),
    ),
    "DerivativeDiscrete without a filter": (
        DerivativeDiscrete(0.1, filter_type="none", filter_coefficient=2.0),
        DerivativeDiscrete(0.1), (Clock(),),
    ),
    "PIDDiscrete": (
        PIDDiscrete(0.1, 1.0, ki=2.0, kd=3.0, filter_type="backward", filter_coefficient=5.0,
                    enable_external_initial_state=False),
        PIDDiscrete(0.1, 1.0, ki=2.0, kd=3.0, n=5.0), (Clock(),),
    ),
    "LTISystem": (
        LTISystem(A, B, B, initialize_states=[2.0]), LTISystem(A, B, B, initial_state=[2.0]),
        (1.0,),
    ),
    "LTISystemDiscrete by position": (
        LTISystemDiscrete(A, B, B, [[0.0]], 0.1, initialize_states=[2.0]),
        LTISystemDiscrete(0.1, A, B, B, initial_state=[2.0]), (1.0,),
    ),
    "Product": (
        Product(2, operators="*/", denominator_limit=None, divide_by_zero_behavior=None),
        Product("*/"), (3.0, 2.0),
    ),
    "Saturate": (
        Saturate(upper_limit=1.0, enable_dynamic_upper_limit=False), Saturate(upper_limit=1.0),
        (3.0,),
    ),
    "PIDDiscrete without a filter": (
        PIDDiscrete(0.1, 1.0, 2.0, 0.0, filter_type="none", filter_coefficient=3.0),
        PIDDiscrete(0.1, 1.0, ki=2.0), (Clock(),),
    ),
    "DiscreteClock": (
        DiscreteClock(0.1, start_time=0.0, dtype=np.dtype(float)), DiscreteClock(0.1), (),
    ),
    "Integrator": (Integrator(1.0, dtype=float), Integrator(1.0), (2.0,)),
    "ScalarBroadcast": (ScalarBroadcast(m=3, n=None), ScalarBroadcast(3), (2.0,)),
    "Slice": (Slice(slice_="0:2"), Slice("0:2"), ([1.0, 2.0, 3.0],)),
    "Adder": (Adder(2, operators="+-"), Adder("+-"), (1.0, 2.0)),
}  # fmt: skip


@pytest.mark.parametrize("case", ALIKE)
def test_arguments_of_pycollimator_make_the_same_block(case):
    theirs, ours, inputs = ALIKE[case]
    t = np.linspace(0.0, 1.0, 7)
    found, expected = (saltus.response(block, *inputs, t=t) for block in (theirs, ours))
    np.testing.assert_equal(found, expected)


def test_a_rigid_body_by_the_names_of_pycollimator():
    theirs = RigidBody(
        mass=2.0, inertia_matrix=np.diag([1.0, 2.0, 3.0]), gravity_vector=[0.0, 0.0, -9.8],
        initial_angular_velocity=[1.0, 0.0, 0.0], enable_external_mass=False,
    )  # fmt: skip
    ours = RigidBody(
        2.0, np.diag([1.0, 2.0, 3.0]), gravity=[0.0, 0.0, -9.8], initial_rates=[1.0, 0.0, 0.0]
    )
    one, other = theirs.create_context(), ours.create_context()
    np.testing.assert_array_equal(one.continuous_state, other.continuous_state)
    np.testing.assert_equal(one.parameters, other.parameters)


REFUSED = {
    "tolerances of a comparison": (lambda: Comparator(atol=1e-5, operator=">"), "is exact"),
    "a moving limit": (lambda: Saturate(enable_dynamic_upper_limit=True), "MinMax block"),
    "an int": (lambda: Clock(dtype=int), "dtype = <class 'int'>: every value is a double"),
    "a truth as a number": (lambda: RandomNumber(0.1, shape=(3,)), "of this shape"),
    "another filter": (
        lambda: DerivativeDiscrete(0.1, filter_type="bilinear", filter_coefficient=1.0),
        "'bilinear': the filter is 'backward' here",
    ),
    "a derivative without a filter": (
        lambda: PIDDiscrete(0.1, kd=1.0, filter_type="none"),
        "'none': the filter is 'backward' here",
    ),
    "an input for a start": (lambda: PID(enable_external_initial_state=True), "initial_state"),
    "a file": (lambda: DataSource(file_name="a.csv"), r"DataSource\.from_csv"),
    "the Zeno point": (lambda: Integrator(reset_on_enter_zeno=True), "its Zeno point"),
    "noise": (lambda: WhiteNoise(noise_power=1.0), "power = noise_power"),
    "machine data": (lambda: StateMachine(sm_data={}), "give states and transitions"),
    "by both names": (
        lambda: Multiplexer(n_in=2, n_inputs=3), "'n_in' is called 'n_inputs' here; give one",
    ),
    "parameters of a function": (
        lambda: FeedthroughBlock(func=abs, parameters={"k": 1.0}), "LeafSystem of your own",
    ),
    "one limit without a name": (lambda: Saturate(1.0), "say which limit it is"),
    "a truth as a limit": (lambda: Saturate(1.0, False), "upper_limit: expected numbers"),
    "a truth as another limit": (lambda: RateLimiter(0.1, 1.0, False), "lower_limit: expected"),
    "a width before the period": (
        lambda: Pulse(1.0, 0.5, 2.0), r"at most 1 arguments without a name \(amplitude\), found 3",
    ),
    "an interpolation": (
        lambda: LookupTable2d([0, 1], [0, 1], [[0, 1], [1, 2]], interpolation="cubic"),
        "unknown option 'interpolation'",
    ),
    "an interpolation that is no text": (
        lambda: LookupTable2d([0, 1], [0, 1], [[0, 1], [1, 2]], interpolation=np.zeros(2)),
        "unknown option 'interpolation'",
    ),
    "a filter by position and none by name": (
        lambda: DerivativeDiscrete(0.1, 2.0, filter_type="none"), "the filter is 'backward' here",
    ),
    "a filter without a coefficient, which has another default": (
        lambda: DerivativeDiscrete(0.1, filter_type="backward"), "say filter_coefficient too",
    ),
    "a PID with a filter without a coefficient": (
        lambda: PIDDiscrete(0.1, 1.0, 2.0, 3.0, filter_type="backward"), "filter_coefficient too",
    ),
    "a derivative by position without a filter": (
        lambda: PIDDiscrete(0.1, 1.0, 0.0, 2.0, filter_type="none"), "say kd=0.0",
    ),
    "a derivative by default without a filter": (
        lambda: PIDDiscrete(0.1, filter_type="none"), "say kd=0.0",
    ),
    "a start by position": (lambda: PIDDiscrete(0.1, 1.0, 1.0, 1.0, 0.5), "at most 4 arguments"),
    "the power by position": (lambda: WhiteNoise(0.1, 2.0), "at most 1 arguments"),
    "by position and by name": (
        lambda: Multiplexer(2, n_in=3), "'n_in' is called 'n_inputs' here; give one",
    ),
    "an argument of another block": (lambda: Gain(1.0, start_time=0), "option 'start_time'"),
    "an argument of no block": (lambda: Gain(1.0, shape=()), "unknown option 'shape'"),
    "a type of a block of one's own": (
        lambda: saltus.LeafSystem("own", dtype=float), "unknown option 'dtype'",
    ),
    "too many numbers": (lambda: Integrator(0.0, False, True), "give the others by name"),
}  # fmt: skip


@pytest.mark.parametrize("case", REFUSED)
def test_what_would_mean_something_else_is_refused_with_what_to_do(case):
    make, words = REFUSED[case]
    with pytest.raises(saltus.ModelError, match=words):
        make()


def test_derivatives_are_named_where_gradients_are_asked_for():
    with pytest.raises(saltus.ModelError, match="sensitivity="):
        saltus.simulate(Integrator(), (0.0, 1.0), enable_autodiff=True)


@pytest.mark.parametrize(("name", "here"), saltus.errors.NAMES_OF_OTHERS.items())
def test_an_exception_of_pycollimator_is_answered(name, here):
    assert not here or issubclass(getattr(saltus.errors, here), saltus.Error)
    with pytest.raises(ImportError, match=f"it is {here} here" if here else "leave it out"):
        getattr(saltus.errors, name)
    with pytest.raises(ImportError, match=f"has no '{name}'; "):
        exec(f"from saltus.errors import {name}")


def test_an_unknown_exception_is_an_attribute_error():
    assert not hasattr(saltus.errors, "NoSuchError")
