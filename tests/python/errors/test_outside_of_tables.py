"""A run that ends outside of a table says the input, the points, the block and the time."""

import pytest
import saltus
from saltus.library import (
    Clock,
    Constant,
    Gain,
    Integrator,
    Logarithm,
    LookupTable1d,
    LookupTable2d,
    LookupTableNd,
    Saturate,
)  # fmt: skip


def table(kind, extrapolation="error"):
    if kind == 1:
        return LookupTable1d([0.0, 1.5], [0.0, 1.0], extrapolation=extrapolation, name="tab")
    axes, values = ([0.0, 1.5], [0.0, 9.0]), [[0.0, 1.0], [2.0, 3.0]]
    if kind == 2:
        return LookupTable2d(*axes, values, extrapolation=extrapolation, name="tab")
    return LookupTableNd(axes, values, extrapolation=extrapolation, name="tab")


def message_of(source, first, *behind, throw=True):
    """In a diagram within a diagram."""
    inner = saltus.DiagramBuilder()
    source, last = inner.add(source), inner.add(first)
    for i in range(len(first.input_names)):
        inner.connect(source.output(), first.input(i))
    for block in behind:
        inner.add(block)
        inner.connect(last.output(), block.input())
        last = block
    inner.export_output(last.output(), "o")
    outer = saltus.DiagramBuilder()
    part = outer.add(inner.build(name="part"))
    outer.export_output(part.output("o"), "o")
    system = outer.build()
    if not throw:
        return saltus.simulate(system, (0.0, 2.0), throw=False).message
    with pytest.raises(saltus.SimulationError) as caught:
        saltus.simulate(system, (0.0, 2.0))
    assert caught.value.results.message == str(caught.value)
    assert caught.value.block.startswith("part.")
    return str(caught.value)


@pytest.mark.parametrize("throw", [True, False])
@pytest.mark.parametrize("kind", [1, 2, 3])
def test_a_recorded_output(kind, throw):
    said = message_of(Constant(5.0), table(kind), throw=throw)
    name = "in" if kind == 1 else "in_0"
    assert "t = 0 s: output 'part.tab.out'" in said
    assert f"{name} = 5.0" in said
    assert f"the table 'tab' has the points 0 to 1.5 of '{name}', and extrapolation='error'" in said
    assert "say extrapolation='clip'" in said


@pytest.mark.parametrize("behind", [[], [Gain]])
def test_an_output_that_a_derivative_reads(behind):
    said = message_of(Clock(), table(1), *(gain(2.0) for gain in behind), Integrator(0.0))
    assert "t = 1.49" in said or "t = 1.5" in said
    assert "where in = [1.5" in said and "points 0 to 1.5 of 'in'" in said


def test_a_block_behind_the_table_names_the_table():
    said = message_of(Constant(5.0), table(1), Saturate(0.0, 1.0, name="limit"))
    assert "'part.limit.out'" in said and "the table 'tab' has the points 0 to 1.5" in said


def test_any_block_shows_its_input():
    said = message_of(Constant(-3.0), Logarithm(name="log"))
    assert "'part.log.out'" in said and "in = -3.0" in said and "table" not in said


def test_a_table_alone_and_a_table_in_a_simulator():
    with pytest.raises(saltus.SimulationError, match=r"the table 'tab' has the points 0 to 1\.5"):
        builder = saltus.DiagramBuilder()
        source, tab = builder.add(Constant(5.0), table(1))
        builder.connect(source.output(), tab.input())
        builder.export_output(tab.output(), "o")
        diagram = builder.build()
        saltus.Simulator(diagram).advance_to(1.0, diagram.create_context())
