"""Places outside the state that one callback can write and another one read.

Each function returns (read, write): `read()` gives a number, 1.0 at the beginning; `write(v)` sets
it to v.
"""

import dataclasses
import functools
import heapq
import operator
from collections import deque
from types import SimpleNamespace

import numpy as np

LEVEL = 1.0
LEVELS = {"a": 1.0}


def attribute():
    place = SimpleNamespace(u=1.0)

    def write(v):
        place.u = v

    return lambda: place.u, write


def attribute_by_setattr():
    place = SimpleNamespace(u=1.0)
    return lambda: place.u, lambda v: setattr(place, "u", v)


def attribute_by_dict():
    place = SimpleNamespace(u=1.0)
    return lambda: place.u, lambda v: place.__dict__.update(u=v)


def attribute_by_a_computed_name():
    place = SimpleNamespace(u1=1.0)
    return lambda: place.u1, lambda v: vars(place).__setitem__(f"u{int(v > 0)}", v)


def attribute_in_place():
    place = SimpleNamespace(u=1.0)

    def write(v):
        place.u -= place.u - v

    return lambda: place.u, write


class WithSlots:
    __slots__ = ("u",)


def attribute_in_slots():
    place = WithSlots()
    place.u = 1.0

    def write(v):
        place.u = v

    return lambda: place.u, write


def attribute_of_a_class():
    class Place:
        u = 1.0

    def write(v):
        Place.u = v

    return lambda: Place.u, write


def attribute_that_hides_that_of_the_class():
    class Place:
        u = 1.0

    place = Place()

    def write(v):
        place.u = v

    return lambda: place.u, write


def attribute_by_a_property():
    class Place:
        _u = 1.0

        @property
        def u(self):
            return self._u

        @u.setter
        def u(self, v):
            self._u = v

    place = Place()

    def write(v):
        place.u = v

    return lambda: place.u, write


def attribute_by_the_property_of_another():
    class Place:
        u = 1.0

        @property
        def twice(self):
            return 2.0 * self.u

        @twice.setter
        def twice(self, v):
            self.u = 0.5 * v

    place = Place()

    def write(v):
        place.twice = 2.0 * v

    return lambda: place.u, write


def attribute_by_a_descriptor():
    class Other:
        def __get__(self, owner, kind):
            return owner.u

        def __set__(self, owner, v):
            owner.u = v

    class Place:
        u = 1.0
        other = Other()

    place = Place()

    def write(v):
        place.other = v

    return lambda: place.u, write


def attribute_by_its_own_setattr():
    class Place:
        u = 1.0

        def __setattr__(self, name, v):
            super().__setattr__("u", v)

    place = Place()

    def write(v):
        place.w = v

    return lambda: place.u, write


def attribute_of_a_nested_object():
    place = SimpleNamespace(inner=SimpleNamespace(parts=[SimpleNamespace(u=1.0)]))

    def write(v):
        place.inner.parts[0].u = v

    return lambda: place.inner.parts[0].u, write


def object_replaced():
    place = SimpleNamespace(inner=SimpleNamespace(u=1.0))

    def write(v):
        place.inner = SimpleNamespace(u=v)

    return lambda: place.inner.u, write


@dataclasses.dataclass
class Data:
    u: float = 1.0


def dataclass_replaced():
    place = [Data()]

    def write(v):
        place[0] = dataclasses.replace(place[0], u=v)

    return lambda: place[0].u, write


class Machine:
    """Its methods change it; the code of a callback shows no assignment."""

    def __init__(self):
        self.u = 1.0
        self.log = [1.0]

    def move(self, v):
        self.u = v

    def note(self, v):
        self.log.append(v)

    def __call__(self, v):
        self.move(v)

    def __ilshift__(self, v):
        self.u = v
        return self

    def __setitem__(self, key, v):
        self.u = v

    def __enter__(self):
        return self

    def __exit__(self, *error):
        self.u += 1.0

    def __iter__(self):
        self.u += 1.0
        return iter([self.u])


def object_by_its_method():
    place = Machine()
    return lambda: place.u, lambda v: place.move(v)


def object_by_a_bound_method():
    place = Machine()
    return lambda: place.u, place.move


def object_by_its_call():
    place = Machine()
    return lambda: place.u, place


def object_by_its_list():
    place = Machine()
    return lambda: place.log[-1], place.note


def object_by_an_operator():
    place = Machine()

    def write(v):
        one = place
        one <<= v

    return lambda: place.u, write


def object_by_its_item():
    place = Machine()

    def write(v):
        place["u"] = v

    return lambda: place.u, write


def object_by_iteration():
    place = Machine()

    def write(v):
        list(place)

    return lambda: place.u, write


def object_by_a_context():
    place = Machine()

    def write(v):
        with place:
            pass

    return lambda: place.u, write


def entry_of_a_dictionary():
    place = {"u": 1.0}

    def write(v):
        place["u"] = v

    return lambda: place["u"], write


def dictionary_updated():
    place = {"u": 1.0}
    return lambda: place["u"], lambda v: place.update(u=v)


def dictionary_merged():
    place = {"u": 1.0}

    def write(v):
        nonlocal place
        place |= {"u": v}

    return lambda: place["u"], write


def dictionary_in_a_dictionary():
    place = {"inner": {"u": 1.0}}

    def write(v):
        inner = place["inner"]
        inner["u"] = v

    return lambda: place["inner"]["u"], write


def list_entry():
    place = [1.0]

    def write(v):
        place[0] = v

    return lambda: place[0], write


def list_appended():
    place = [1.0]
    return lambda: place[-1], lambda v: place.append(v)


def list_appended_by_its_type():
    place = [1.0]
    return lambda: place[-1], lambda v: list.append(place, v)


def list_by_a_method_kept():
    place = [1.0]
    append = place.append
    return lambda: place[-1], lambda v: append(v)


def list_by_operator():
    place = [1.0]
    return lambda: place[0], lambda v: operator.setitem(place, 0, v)


def list_by_methodcaller():
    place = [1.0]
    return lambda: place[0], lambda v: operator.methodcaller("insert", 0, v)(place)


def list_by_a_library():
    place = [1.0]
    return lambda: place[0], lambda v: heapq.heappush(place, -v)


def list_grown_in_place():
    place = [1.0]

    def write(v):
        one = place
        one += [v]

    return lambda: place[-1], write


def list_by_a_helper():
    place = [1.0]

    def put(where, v):
        where[0] = v

    return lambda: place[0], lambda v: put(place, v)


def list_by_a_partial():
    place = [1.0]

    def put(where, v):
        where[0] = v

    return lambda: place[0], functools.partial(put, place)


def list_by_map():
    place = [1.0]

    def put(v):
        place[0] = v

    return lambda: place[0], lambda v: list(map(put, [v]))


def list_by_a_dispatch():
    place = [1.0]

    def put(v):
        place[0] = v

    table = {"put": put}
    return lambda: place[0], lambda v: table["put"](v)


def list_by_a_wrapped_function():
    place = [1.0]

    def put(v):
        place[0] = v

    @functools.wraps(put)
    def wrapper(*arguments):
        return put(*arguments)

    return lambda: place[0], wrapper


def list_in_a_default():
    place = [1.0]

    def write(v, where=place):
        where[0] = v

    return lambda: place[0], write


def length_of_a_list():
    place = [0.0]
    return lambda: float(len(place)), lambda v: place.append(v)


def double_ended_queue():
    place = deque([1.0])
    return lambda: place[-1], lambda v: place.append(v)


def array_entry():
    place = np.array([1.0, 2.0])

    def write(v):
        place[0] = v

    return lambda: place[0], write


def array_filled():
    place = np.ones(2)
    return lambda: place[0], lambda v: place.fill(v)


def array_in_place():
    place = np.ones(2)

    def write(v):
        one = place
        one *= v / one[0]

    return lambda: place[1], write


def array_by_out():
    place = np.ones(2)
    return lambda: place[0], lambda v: np.add(v, np.zeros(2), out=place)


def array_by_copyto():
    place = np.ones(2)
    return lambda: place[0], lambda v: np.copyto(place, v)


def array_by_its_flat():
    place = np.ones(2)

    def write(v):
        place.flat = v

    return lambda: place[0], write


def array_by_its_memory():
    place = np.ones(2)

    def write(v):
        memoryview(place)[0] = v

    return lambda: place[0], write


def array_by_a_positional_out():
    place = np.ones(2)
    return lambda: place[0], lambda v: np.multiply(v, np.ones(2), place)


def array_by_a_view():
    place = np.ones(4)
    view = place[1:3].reshape(2, 1)

    def write(v):
        view[:] = v

    return lambda: place[2], write


def array_by_its_iterator():
    place = np.ones(2)

    def write(v):
        for one in np.nditer(place, op_flags=["readwrite"]):
            one[...] = v

    return lambda: place[0], write


def array_read_by_a_view():
    place = np.ones(4)
    view = place[1:3]

    def write(v):
        place[:] = v

    return lambda: view[0], write


def global_variable():
    global LEVEL
    LEVEL = 1.0

    def write(v):
        global LEVEL
        LEVEL = v

    return lambda: LEVEL, write


def global_by_globals():
    global LEVEL
    LEVEL = 1.0
    return lambda: LEVEL, lambda v: globals().update(LEVEL=v)


def global_dictionary():
    LEVELS["a"] = 1.0

    def write(v):
        LEVELS["a"] = v

    return lambda: LEVELS["a"], write


def variable_of_a_closure():
    place = 1.0

    def write(v):
        nonlocal place
        place = v

    return lambda: place, write


def variable_of_an_inner_function():
    place = 1.0

    def write(v):
        def inner():
            nonlocal place
            place = v

        inner()

    return lambda: place, write


def function_replaced():
    def place():
        return 1.0

    def write(v):
        nonlocal place
        place = lambda: v  # noqa: E731

    return lambda: place(), write


def generator():
    place = [1.0]

    def run():
        while True:
            place[0] = yield

    running = run()
    next(running)
    return lambda: place[0], lambda v: running.send(v)


def random_generator():
    place, known = np.random.default_rng(1), np.ones(1)
    return lambda: known[0], lambda v: place.random(out=known)


def object_of_code_without_a_module():
    code = """
class Place:
    u = 1.0

    def move(self, v):
        self.u = v

place = Place()

def read():
    return place.u

def write(v):
    place.move(v)
"""
    exec(code, made := {})
    return made["read"], made["write"]


def memo():
    known = {"u": 1.0}

    def write(v):
        if v not in known:
            known[v] = v
        known["u"] = known[v]

    return lambda: known["u"], write


PLACES = {
    name: made
    for name, made in globals().items()
    if callable(made) and getattr(made, "__module__", "") == __name__
    and not isinstance(made, type)
}  # fmt: skip
"""every place by its name"""
