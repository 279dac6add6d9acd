"""Declarations of a Python block that are refused, and its name."""

import pytest
import saltus
from declared import Block


def test_default_name_is_class_and_id():
    class Engine(saltus.LeafSystem):
        pass

    engine = Engine()
    assert engine.name == f"Engine_{engine.system_id}"


@pytest.mark.parametrize(
    ("declare", "message"),
    [
        (
            lambda s: s.declare_continuous_state(),
            "block 'block': continuous state: give a shape, such as 2, or a default_value",
        ),
        (
            lambda s: s.declare_continuous_state(2, ode=3),
            "block 'block': ode: expected a function, found 3",
        ),
        (
            lambda s: (s.declare_continuous_state(1), s.declare_continuous_state(1)),
            "block 'block': the continuous state is declared twice; declare it once, as one vector",
        ),
        (
            lambda s: s.declare_continuous_state(1, mass_matrix=[1]),
            "declare_continuous_state: no option 'mass_matrix': divide by it in the ode",
        ),
        (
            lambda s: s.declare_continuous_state(1, odd=len),
            "declare_continuous_state: unknown option 'odd'; did you mean 'ode'? "
            "Known: 'shape', 'default_value', 'ode', 'requires_inputs', 'jacobian', "
            "'jacobian_sparsity', 'sparse_jacobian', 'formula', 'names', 'units', 'derivatives'",
        ),
        (
            lambda s: s.declare_zero_crossing(len, direction="crosses_zer0"),
            "block 'block': zero crossing 'zero_crossing_0': "
            "unknown direction 'crosses_zer0'; did you mean 'crosses_zero'? "
            "Known: 'none', 'crosses_zero', "
            "'positive_then_non_positive', 'negative_then_non_negative', 'edge_detection'",
        ),
        (
            lambda s: s.declare_output_port(len, offset=0.1),
            "block 'block': output: an offset without a period; give both",
        ),
        (
            lambda s: s.declare_output_port(len, reads=["mood"]),
            "block 'block': output 'out_0' reads 'mood'; did you mean 'mode'? "
            "Known: 'time', 'continuous_state', 'discrete_state', 'mode', 'inputs', 'relations'",
        ),
        (
            lambda s: s.declare_dynamic_parameter("k", "much"),
            "block 'block': parameter 'k': expected numbers, found 'much' (str)",
        ),
        (
            lambda s: s.declare_periodic_update(len, period=0.0),
            "block 'block': periodic update 'periodic_0': period 0 s, offset 0 s; "
            "expected period > 0 and a finite offset",
        ),
    ],
)
def test_bad_declarations(declare, message):
    with pytest.raises(saltus.ModelError) as caught:
        Block(declare)
    assert str(caught.value) == message
