"""Groups of blocks that belong together, which chance would hardly ever connect so."""

from __future__ import annotations

from typing import Any

from draw_leaf import NUMBERS
from hypothesis import strategies as st
from scene import Part

Source = tuple[int, int] | None
CONTACTS = st.sampled_from(
    [
        ("Comparator", {"operator": "<"}),
        ("Comparator", {"operator": "<="}),
        ("ReduceBlock", {"function": "less"}),
    ]
)
RESET = {"enable_reset": True, "enable_external_reset": True}


@st.composite
def ball(draw: Any, first: int, known: st.SearchStrategy) -> list[Part]:
    """A ball as two integrators, over a floor."""
    floor = draw(known)
    contact = draw(CONTACTS)
    e, y, v = draw(st.sampled_from([0.5, 0.9, 1.0, 0.0])), draw(NUMBERS), draw(NUMBERS)
    hit, rebound = (first + 3, 0), (first + 4, 0)
    return [
        Part("Constant", {"value": -9.81}),
        Part("Integrator", {"initial_state": v, **RESET}, ((first, 0), hit, rebound)),
        Part("Integrator", {"initial_state": y, **RESET}, ((first + 1, 0), hit, floor)),
        Part(*contact, ((first + 2, 0), floor)),
        Part("Gain", {"gain": -e}, ((first + 1, 0),)),
    ]


@st.composite
def relay(draw: Any, first: int, known: st.SearchStrategy) -> list[Part]:
    """dx/dt = a where x >= level, else b: it slides where they point at each other."""
    return [
        Part("Integrator", {"initial_state": draw(NUMBERS)}, ((first + 4, 0),)),
        Part("Comparator", {"operator": ">="}, ((first, 0), draw(known))),
        Part("Constant", {"value": draw(NUMBERS)}),
        Part("Constant", {"value": draw(NUMBERS)}),
        Part("Switch", {}, ((first + 2, 0), (first + 1, 0), (first + 3, 0))),
    ]


@st.composite
def pair(draw: Any, first: int, known: st.SearchStrategy) -> list[Part]:
    """A vector of two integrators, reset where the first passes the second."""
    start = {"initial_state": [draw(NUMBERS), draw(NUMBERS)], "enable_reset": True}
    return [
        Part("Multiplexer", {"n_inputs": 2}, (draw(known), draw(known))),
        Part("Integrator", start, ((first, 0), (first + 3, 0))),
        Part("Demultiplexer", {"n_outputs": 2}, ((first + 1, 0),)),
        Part("Comparator", {"operator": ">"}, ((first + 2, 0), (first + 2, 1))),
    ]


GROUPS = st.sampled_from([ball, relay, pair])
