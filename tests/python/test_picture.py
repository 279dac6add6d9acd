"""Pictures of systems: what is in them, that names cannot break them, that `dot` draws them."""

import re
import shutil
import subprocess
import xml.etree.ElementTree as ElementTree

import pytest
import saltus
from saltus.library import (
    Comparator,
    Constant,
    Gain,
    Integrator,
    Multiplexer,
    ReduceBlock,
    Step,
)
from systems import Ball

needs_dot = pytest.mark.skipif(shutil.which("dot") is None, reason="needs Graphviz")
NASTY = [
    'say "so"',
    "a<b>&amp;",
    "two\nlines",
    "Größe 高さ",
    "back\\slash\\N",
    "`#;|{}[]()`",
    "end",
]


def ball_of_blocks():
    """The tutorial's diagram: two integrators that a comparison resets."""
    builder = saltus.DiagramBuilder()
    v, y = (
        builder.add(Integrator(enable_reset=True, enable_external_reset=True, name=name))
        for name in ("velocity", "height")
    )
    weight, floor, below, rebound = builder.add(
        Constant(-9.81, name="weight"),
        Step(0.0, -1.0, step_time=5.0, name="floor"),
        Comparator("<", name="below"),
        Gain(-0.9, name="rebound"),
    )
    for source, target in (
        (weight, v.input("in")),
        (v, y.input("in")),
        (y, below.input(0)),
        (floor, below.input(1)),
        (below, v.input("reset_trigger")),
        (below, y.input("reset_trigger")),
        (v, rebound.input()),
        (rebound, v.input("reset_value")),
        (floor, y.input("reset_value")),
    ):
        builder.connect(source.output(), target)
    return builder.build("ball")


def nested():
    """A sine no one reads, and a gain two diagrams deep that reads a vector."""
    builder = saltus.DiagramBuilder()
    gain = builder.add(Gain(2.0, name="gain"))
    builder.export_input(gain.input(), "u")
    builder.export_output(gain.output(), "y")
    inner = builder.build("inner")
    builder = saltus.DiagramBuilder()
    builder.add(inner)
    builder.export_input(inner.input(), "into")
    builder.export_output(inner.output(), "out of")
    outer = builder.build("outer")
    builder = saltus.DiagramBuilder()
    x, outer, unread = builder.add(
        Integrator([1.0, 2.0, 3.0], name="x"), outer, Gain(3.0, name="unread")
    )
    builder.connect(x.output(), outer.input())
    builder.connect(outer.output(), x.input())
    builder.connect(x.output(), unread.input())
    return builder.build("whole")


class Dot:
    """The blocks, wires and clusters of a DOT text, found by the names in it."""

    def __init__(self, text):
        self.text = text
        labels = re.findall(r"^ *(b\d+) \[.*?(?:<B>(.*?)</B>|label=\"(.*?)\") ?.*\];$", text, re.M)
        self.names = {node: bold or plain for node, bold, plain in labels}
        self.lines = {
            self.names[match[1]]: match[0]
            for match in re.finditer(r"^ *(b\d+) \[.*\];$", text, re.M)
        }
        self.wires = {}
        for match in re.finditer(r"^ *(b\d+)\S* -> (b\d+)(\S*) \[(.*)\];$", text, re.M):
            key = self.names[match[1]], self.names[match[2]], match[3]
            self.wires[key] = match[4]
        self.clusters = re.findall(
            r"subgraph cluster_\d+ \{\s*labelloc=t fontsize=11 label=<<B>(.*?)</B>>", text
        )


def test_dot_has_every_block_and_wire():
    dot = Dot(ball_of_blocks().to_dot())
    assert set(dot.lines) == {"velocity", "height", "weight", "floor", "below", "rebound"}
    assert len(dot.wires) == 9
    assert "Comparator" in dot.lines["below"]
    assert "1 state" in dot.lines["height"]
    assert not dot.clusters


def test_wires_read_at_events_only_are_dashed():
    """The loops through the resets, and no others: the trigger and the value."""
    dot = Dot(ball_of_blocks().to_dot())
    dashed = {key[:2] for key, style in dot.wires.items() if "dashed" in style}
    assert dashed == {
        ("below", "velocity"),
        ("below", "height"),
        ("rebound", "velocity"),
        ("floor", "height"),
    }
    assert "read at events only" in dot.text


def colour(line):
    return re.search(r'\bcolor="(#\w+)"', line)[1]


def test_what_is_continuous_held_folded_and_dropped_looks_so():
    dot = Dot(ball_of_blocks().to_dot())
    assert colour(dot.lines["height"]) == colour(dot.lines["rebound"])
    assert colour(dot.lines["below"]) == colour(dot.lines["floor"])
    assert len({colour(dot.lines[name]) for name in ("height", "below", "weight")}) == 3
    for says in ("continuous", "held between instants", "folded"):
        assert says in dot.text
    assert "dropped" not in dot.text  # everything is read


def test_what_nothing_reads_is_dropped():
    diagram = nested()
    dot = Dot(diagram.to_dot())
    assert "dotted" in dot.lines["unread"]
    assert "dotted" not in dot.lines["gain"]
    assert "dropped: nothing reads it" in dot.text
    recorded = Dot(diagram.to_dot(recorded_signals={"z": diagram["unread"].output()}))
    assert "dotted" not in recorded.lines["unread"]
    assert "dropped" not in recorded.text


def test_an_output_of_the_system_counts_as_read():
    builder = saltus.DiagramBuilder()
    one = builder.add(Constant(1.0, name="one"))
    builder.export_output(one.output(), "y")
    diagram = builder.build()
    assert "dropped" not in diagram.to_dot()
    assert "dropped" in diagram.to_dot(recorded_signals={})


def test_inner_diagrams_are_clusters_and_wires_carry_widths():
    dot = Dot(nested().to_dot())
    assert dot.clusters == ["outer", "inner"]
    assert set(dot.lines) >= {"x", "gain", "unread", "into", "u", "y", "out of"}
    assert all('label="3"' in style for style in dot.wires.values())
    nesting = [m.start() for m in re.finditer("subgraph|<B>gain</B>|<B>x</B>", dot.text)]
    assert dot.text.index("<B>gain</B>") > nesting[1] > nesting[0]


def test_max_depth_makes_one_block_of_an_inner_diagram():
    dot = Dot(nested().to_dot(max_depth=1))
    assert not dot.clusters
    assert set(dot.lines) == {"x", "outer", "unread"}
    assert "Diagram" in dot.lines["outer"]
    assert list(Dot(nested().to_dot(max_depth=0)).lines) == ["whole"]
    with pytest.raises(saltus.ModelError, match="max_depth: expected a number of levels"):
        nested().to_dot(max_depth=-1)


def test_port_names_are_shown_where_they_say_something():
    dot = Dot(ball_of_blocks().to_dot())
    assert "reset_trigger" in dot.lines["height"]
    assert ">in<" not in dot.lines["rebound"]


class Heater(saltus.LeafSystem):
    """Two modes, three zero crossings and a tick."""

    def __init__(self):
        super().__init__(name="heater")
        self.declare_continuous_state(1, ode=lambda time, state: -state.continuous_state)
        self.declare_default_mode(0)
        for name, start, end, direction in (
            ("cold", 0, 1, "positive_then_non_positive"),
            ("warm", 1, 0, "negative_then_non_negative"),
        ):
            self.declare_zero_crossing(
                lambda time, state: state.continuous_state[0] - 0.5,
                name=name,
                start_mode=start,
                end_mode=end,
                direction=direction,
            )
        self.declare_zero_crossing(
            lambda time, state: time - 3.0, name="over", terminal=True, direction="crosses_zero"
        )
        self.declare_periodic_update(lambda time, state: state, period=0.5, name="tick")


def test_a_leaf_is_one_block_with_its_crossings():
    dot = Dot(Ball().to_dot())
    assert list(dot.lines) == ["ball"]
    for says in ("Ball", "2 states", "bounce ↓ reset"):
        assert says in dot.lines["ball"]
    line = Dot(Heater().to_dot()).lines["heater"]
    for says in ("begins in mode 0", "mode 0: cold ↓ → mode 1", "over ↕ end of run", "every 0.5 s"):
        assert says in line


def test_the_modes_of_a_leaf_are_a_state_diagram():
    lines = [line.strip() for line in Heater().to_mermaid("modes").splitlines()]
    assert lines[0] == "stateDiagram-v2"
    assert "[*] --> m0" in lines
    assert "m0 --> m1 : cold ↓" in lines
    assert "m1 --> m0 : warm ↑" in lines
    assert {"m0 --> [*] : over ↕ end of run", "m1 --> [*] : over ↕ end of run"} <= set(lines)
    with pytest.raises(saltus.ModelError, match="block 'ball' has no modes to draw"):
        Ball().to_mermaid("modes")
    with pytest.raises(saltus.ModelError, match="did you mean 'modes'"):
        Heater().to_mermaid("mode")
    with pytest.raises(saltus.ModelError, match="takes neither"):
        Heater().to_mermaid("modes", max_depth=1)


def test_an_open_diagram_and_one_that_cannot_run_are_drawn():
    builder = saltus.DiagramBuilder()
    gain = builder.add(Gain(2.0, name="gain"))
    builder.export_input(gain.input(), "u")
    builder.export_output(gain.output(), "y")
    dot = Dot(builder.build().to_dot())
    assert set(dot.wires) == {("u", "gain", ":w"), ("gain", "y", ":w")}
    assert "continuous" in dot.text

    builder = saltus.DiagramBuilder()
    one, three = builder.add(Constant(1.0, name="one"), ReduceBlock(1, lambda u: [u[0]] * 3))
    two = builder.add(Integrator([0.0, 0.0], name="two"))
    builder.connect(one.output(), three.input())
    builder.connect(three.output(), two.input())  # of a width that only a call tells
    wide = builder.build()
    dot = Dot(wide.to_dot())
    assert len(dot.wires) == 2
    assert "expected shape (2,), found shape (3,)" in dot.text
    assert "expected shape" in wide.to_mermaid()  # where parentheses are entities


def test_a_recorded_signal_of_another_system_is_refused():
    with pytest.raises(saltus.ModelError, match="not part of this system"):
        nested().to_dot(recorded_signals={"y": Gain(1.0).output()})
    with pytest.raises(saltus.ModelError, match="expected a port"):
        nested().to_mermaid(recorded_signals={"y": 1})


def test_a_scene_of_the_shelf_is_drawn():
    """Systems made in C++, and these within a diagram of Python."""
    scene = saltus.scene("bouncing-ball-blocks").system
    assert len(Dot(scene.to_dot()).lines) >= 5
    builder = saltus.DiagramBuilder()
    builder.add(scene)
    assert Dot(builder.build().to_dot()).clusters == [scene.name]
    assert "BouncingBall" in saltus.scene("bouncing-ball").system.to_mermaid()


# --- names that could break it --------------------------------------------------------------------


def diagram_of(names):
    builder = saltus.DiagramBuilder()
    sources = [builder.add(Constant(1.0, name=name)) for name in names]
    together = builder.add(Multiplexer(len(names), name="together"))
    for i, source in enumerate(sources):
        builder.connect(source.output(), together.input(i))
        builder.export_output(source.output(), f"y {names[i]}")
    inner = builder.build(names[0])
    builder = saltus.DiagramBuilder()
    builder.add(inner)
    return builder.build(names[1])


def drawn(text, form="svg"):
    """By `dot`, which may not even warn."""
    done = subprocess.run(
        ["dot", f"-T{form}"], input=text.encode(), capture_output=True, timeout=60, check=False
    )
    assert done.returncode == 0, done.stderr.decode()
    assert not done.stderr, done.stderr.decode()
    return done.stdout.decode()


@needs_dot
def test_dot_draws_names_as_they_are():
    tree = ElementTree.fromstring(drawn(diagram_of(NASTY).to_dot()))
    words = " ".join("".join(tree.itertext()).replace("\xa0", " ").split())
    for name in NASTY:
        assert " ".join(name.split()) in words


@needs_dot
@pytest.mark.parametrize("name", saltus.shelf())
def test_dot_draws_every_scene(name):
    assert "<svg" in drawn(saltus.scene(name).system.to_dot())


@needs_dot
def test_every_block_and_wire_is_in_the_drawing():
    tree = ElementTree.fromstring(drawn(nested().to_dot()))
    groups = [group.get("class") for group in tree.iter("{http://www.w3.org/2000/svg}g")]
    assert groups.count("node") == 7
    assert groups.count("edge") == 7
    assert groups.count("cluster") == 2


LABEL = r"(?:[^\"\#`;]|\#\d+;)*"  # no quote, and no entity but by number
MERMAID = re.compile(
    rf"""flowchart\ LR
    | \ +subgraph\ \w+(\["{LABEL}"\])?
    | \ +end
    | \ +\w+(\["{LABEL}"\] | \(\["{LABEL}"\]\) | \[\["{LABEL}"\]\]):::\w+
    | \ +b\d+\ (-->|-\.->)(\|"{LABEL}"\|)?\ b\d+
    | \ +class\ [\w,]+\ frame
    | \ +classDef\ \w+\ [\w\#:,\ -]+
    | \ +linkStyle\ [\d,]+\ stroke:\#\w+""",
    re.X,
)


@pytest.mark.parametrize("make", [ball_of_blocks, nested, Heater, lambda: diagram_of(NASTY)])
def test_mermaid_is_of_the_few_forms_it_shall_have(make):
    text = make().to_mermaid()
    for line in text.splitlines():
        assert MERMAID.fullmatch(line), line
    assert text.count("subgraph ") == len(re.findall(r"^ +end$", text, re.M))


def test_mermaid_shows_what_dot_shows():
    text = ball_of_blocks().to_mermaid()
    assert text.count(" -.->") == 4
    assert len(re.findall(r" b\d+ -->", text)) == 5
    for name in ("velocity", "height", "weight", "floor", "below", "rebound"):
        assert f"<b>{name}</b>" in text
    assert "reset_trigger" in text
    assert "#91;3#93;" in nested().to_mermaid()


# --- notebooks ------------------------------------------------------------------------------------


@needs_dot
def test_a_notebook_shows_the_drawing():
    diagram = ball_of_blocks()
    assert diagram._repr_svg_().startswith("<svg")
    assert diagram._repr_markdown_() is None


def test_without_dot_a_notebook_gets_mermaid(monkeypatch):
    monkeypatch.setattr(shutil, "which", lambda name: None)
    diagram = ball_of_blocks()
    assert diagram._repr_svg_() is None
    text = diagram._repr_markdown_()
    assert text == f"```mermaid\n{diagram.to_mermaid()}```\n"
