"""What event wires refuse, and the words of it."""

import math
import re

import pytest
import saltus
from cells import Beats, Cell, Digits, wired
from saltus.library import Pulse


def builder_of(*blocks):
    builder = saltus.DiagramBuilder()
    for block in blocks:
        builder.add(block)
    return builder


@pytest.mark.parametrize(
    ("wire", "words"),
    [
        (("a.fires", "b.synapse"), "'fires'; did you mean 'fire'"),
        (("a.fire", "b.synaps"), "block 'b' has no event input 'synaps'; did you mean 'synapse'"),
        (("c.fire", "b.synapse"), "connect_event: expected the names of a block and of a port"),
        (("a.fire", "b.synapse", math.nan), "event wire from 'a.fire' to 'b.synapse': weight nan"),
        (("a.fire", "b.synapse", math.inf), "expected a finite number"),
        (("a.fire", "b.synapse", "heavy"), "weight: expected a number, found 'heavy'"),
        (("a.fire", "b.synapse", True), "weight: expected a number, found True"),
        (("a.fire", "b.synapse", 1.0, -1e-3), "delay -0.001 s; expected a finite time >= 0 s"),
        (("a.fire", "b.synapse", 1.0, math.nan), "delay nan s; expected a finite time"),
        (("a.fire", 3), "expected an event input, such as"),
        ((3, "b.synapse"), "expected an event, such as"),
    ],
)
def test_a_bad_wire(wire, words):
    builder = builder_of(Cell("a", 100.0), Cell("b", 0.0))
    with pytest.raises(saltus.ModelError) as caught:
        builder.connect_event(*wire)
    assert words in str(caught.value)


def test_ports_of_the_wrong_kind():
    a, b = Cell("a", 100.0), Cell("b", 0.0)
    builder = builder_of(a, b)
    with pytest.raises(saltus.ModelError, match="expected an event, such as"):
        builder.connect_event(b.event_input("synapse"), b.event_input("synapse"))
    with pytest.raises(saltus.ModelError, match="expected an event input, such as"):
        builder.connect_event(a.event_output("fire"), a.output("v"))


def test_a_block_of_another_diagram():
    builder, other = builder_of(Cell("a", 100.0)), Cell("other", 0.0)
    with pytest.raises(saltus.ModelError, match="block 'other' was not added to this diagram"):
        builder.connect_event("a.fire", other.event_input("synapse"))


def test_an_entry_that_is_missing_or_beyond():
    many = saltus.LeafSystem(name="many")
    many.declare_event_input(lambda t, s, weight: s, name="in", size=3)
    builder = builder_of(Beats(1.0), many)
    with pytest.raises(saltus.ModelError, match=r"has 3 entries.* 0 to 2, found none"):
        builder.connect_event("beats.beat", "many.in")
    with pytest.raises(saltus.ModelError, match=r"has 3 entries.* 0 to 2, found 3"):
        many.event_input("in", 3)
    with pytest.raises(saltus.ModelError, match="expected the position or the name of a port"):
        many.event_input("in", 1.5)


@pytest.mark.parametrize("python", ["traced", "called"])
def test_a_result_of_the_wrong_length(python):
    block = saltus.LeafSystem(name="block")
    block.declare_discrete_state([0.0, 0.0])
    block.declare_event_input(lambda t, s, weight: [weight], name="in")
    diagram = wired(Beats(1.0), block, wires=[("beats.beat", "block.in")])
    with pytest.raises(saltus.ModelError, match="reset map of 'in' returned 1 numbers, expected 2"):
        saltus.simulate(diagram, time_span=(0.0, 2.0), python=python)


def test_a_reset_map_without_the_weight_is_told_its_arguments():
    block = saltus.LeafSystem(name="block")
    block.declare_discrete_state([0.0])
    block.declare_event_input(lambda t, s: [1.0], name="in")
    diagram = wired(Beats(1.0), block, wires=[("beats.beat", "block.in")])
    with pytest.raises(saltus.ModelError, match="weight"):
        saltus.simulate(diagram, time_span=(0.0, 2.0))


def test_declarations():
    block = saltus.LeafSystem(name="block")
    with pytest.raises(saltus.ModelError, match="has 0 entries; expected 1 or more"):
        block.declare_event_input(lambda t, s, weight: s, size=0)
    with pytest.raises(saltus.ModelError, match="expected a function"):
        block.declare_event_input(3)
    block.declare_event_input(lambda t, s, weight: s, name="in")
    with pytest.raises(saltus.ModelError, match="the name 'in' is declared twice"):
        block.declare_event_input(lambda t, s, weight: s, name="in")


def test_a_block_that_a_control_signal_executes():
    digits = Digits()
    builder = builder_of(Beats(1.0), digits, Pulse(period=2.0, name="pulse"))
    builder.connect_event("beats.beat", "digits.digit")
    builder.execute(digits, "pulse.out")
    diagram = builder.build()
    with pytest.raises(saltus.ModelError, match="block 'digits': an event wire starts or ends"):
        saltus.simulate(diagram, time_span=(0.0, 2.0))


def test_a_context_with_deliveries_of_another_system():
    scene = wired(Beats(1.0), Digits(), wires=[("beats.beat", "digits.digit", 1.0, 5.0)])
    cut = saltus.simulate(scene, time_span=(0.0, 2.0)).context
    other = wired(Beats(1.0), Digits(), wires=[("beats.beat", "digits.digit", 1.0, 4.0)])
    forged = other.context_from_json(cut.to_json())
    with pytest.raises(saltus.ModelError, match="no event wire with a delay of 5 s"):
        saltus.simulate(other, forged, (2.0, 9.0))
    with pytest.raises(saltus.ModelError, match="a delivery with a delay of -5 s"):
        scene.context_from_json(re.sub(r'("delay": ?)5\.0', r"\g<1>-5.0", cut.to_json()))
