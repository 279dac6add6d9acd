"""Random scenes: blocks, wires without algebraic loops, options."""

from __future__ import annotations

from typing import Any

from draw_block import NAMES, inputs_of, kind_of
from draw_group import GROUPS
from draw_leaf import options_of, several
from hypothesis import strategies as st
from scene import Part, Scene


@st.composite
def parts(draw: Any, most: int = 8) -> tuple[Part, ...]:
    """Every input is connected to an output before it, or, where no loop can come of it, to any."""
    names = draw(several(NAMES, most))
    kinds = [kind_of(name) for name in names]
    outputs = [
        (i, port, letter, kind.inputs.islower())
        for i, kind in enumerate(kinds)
        for port, letter in enumerate(kind.outputs)
    ]
    result = []
    for i, (name, kind) in enumerate(zip(names, kinds, strict=True)):
        arguments = draw(kind.arguments)
        sources = []
        for letter in inputs_of(name, arguments):
            wanted = "b" if letter in "bB" else "rb"
            known = [
                (part, port)
                for part, port, found, feeds in outputs
                if found in wanted and (letter.isupper() or part < i or not feeds)
            ]
            sources.append(draw(st.sampled_from(known)) if known else None)
        result.append(Part("ReduceBlock" if name == "Truth" else name, arguments, tuple(sources)))
    reals = [(part, port) for part, port, found, _ in outputs if found in "rb"]
    for group in draw(st.lists(GROUPS, max_size=1)):
        result += draw(group(len(result), st.sampled_from([None, *reals])))
    return tuple(result)


OPTIONS = options_of(
    ode_solver_method=st.sampled_from(["auto", "dopri5", "adams", "bdf", "radau", "taylor"]),
    rtol=st.sampled_from([1e-3, 1e-6, 1e-9]),
    event_scan_points=st.integers(0, 4),
    zeno_tolerance=st.sampled_from([1e-6, 1e-3, 1e-4, 1e-2, 1e-6, 0.0]),
    max_minor_step_size=st.sampled_from([0.1, 1.0]),
    max_major_step_length=st.sampled_from([0.3, 1.0]),
    save_steps=st.booleans(),
)


@st.composite
def scenes(draw: Any) -> Scene:
    begin = draw(st.sampled_from([0.0, 0.0, -1.0, 0.1]))
    length = draw(st.sampled_from([1.0, 2.0, 3.0, 0.0]))
    options = draw(OPTIONS)
    if draw(st.booleans()):
        shares = draw(st.sets(st.integers(0, 8), min_size=1, max_size=5))
        options["save_at"] = sorted({begin + length * share / 8 for share in shares})
    return Scene(draw(parts()), (begin, begin + length), options)
