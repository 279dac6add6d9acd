"""What a short run costs beside what it computes: through a `Simulator` used again, through
`simulate` of a system used before, through `solve` of functions seen before.

`python bench/python_cost.py` prints the table. The core's own time is that of its simulator alone,
without results; "more" is the time beyond it. Processor time, the least of some batches: it is
disturbed least by whatever else runs.
"""

import time

import numpy as np
import saltus

AIMS = {"Simulator": 8.0, "simulate": 30.0, "solve": 60.0}  # [us]; for solve, in all


class Thermostat(saltus.LeafSystem):
    """A room that is heated at 19 degrees, and no more at 21."""

    def __init__(self):
        super().__init__(name="room")
        self.declare_continuous_state(default_value=[19.5], ode=self.flow)
        self.declare_default_mode(1)
        self.declare_continuous_state_output("temperature")
        self.declare_zero_crossing(self.warm, name="warm", start_mode=1, end_mode=0)
        self.declare_zero_crossing(self.cold, name="cold", start_mode=0, end_mode=1)

    def flow(self, time, state):
        return [30.0 * state.mode + 5.0 - state.continuous_state[0]]

    def warm(self, time, state):
        return state.continuous_state[0] - 21.0

    def cold(self, time, state):
        return state.continuous_state[0] - 19.0


class Kepler(saltus.LeafSystem):
    """A short arc of an orbit."""

    def __init__(self):
        super().__init__(name="kepler")
        self.declare_continuous_state(default_value=[1.0, 0.0, 0.0, 1.0], ode=self.flow)
        self.declare_continuous_state_output("state")

    def flow(self, time, state):
        x, y, u, v = state.continuous_state
        cube = (x * x + y * y) ** 1.5
        return [u, v, -x / cube, -y / cube]


class Branching(saltus.LeafSystem):
    """A derivative that cannot be traced."""

    def __init__(self):
        super().__init__(name="branching")
        self.declare_continuous_state(default_value=[1.0], ode=self.flow)
        self.declare_continuous_state_output("state")

    def flow(self, time, state):
        (x,) = state.continuous_state
        return [-x] if x > 0.5 else [-2.0 * x]


def branching(kind):
    """A ball of that class whose reset map cannot be traced, beside an ode and a guard that are."""

    class Branches(kind):
        def bounce(self, time, state, **parameters):
            y, v = state.continuous_state
            v = -self.e * v if v < 0.0 else v
            return state.with_continuous_state(np.array([abs(y), v]))

    return Branches(0.9)


def least(run, batches=15, batch=0.02):
    """[us] The processor time of a call."""
    run(), run()
    count, spent = 1, 0.0
    while spent < batch:
        count *= 2
        spent = _spent(run, count)
    return 1e6 * min(_spent(run, count) for _ in range(batches)) / count


def _spent(run, count):
    before = time.process_time()
    for _ in range(count):
        run()
    return time.process_time() - before


def row(name, system, end, context=None):
    """The cost of one scene, in each way."""
    context = context or system.create_context()
    recorded = {"y": system.output(0)}
    simulator = saltus.Simulator(system, recorded_signals=recorded)

    def core():
        simulator._core.initialize(context)
        simulator._core.advance_to(end)

    def again():
        simulator.initialize(context)
        simulator.advance_to(end)
        return simulator.results

    def read():
        results = again()
        return results.time, results.outputs["y"], results.status

    def whole():
        return saltus.simulate(system, context, (0.0, end), recorded_signals=recorded)

    own = least(core)
    more = {"Simulator": again, "its rows read": read, "simulate": whole}
    return {"scene": name, "core": own} | {way: least(run) - own for way, run in more.items()}


def solves():
    """[us] Whole calls of `solve`, of the same functions."""
    floor = saltus.Guard(
        lambda t, x: x[0], reset=lambda t, x: [0.0, -0.7 * x[1]], direction="falling"
    )

    def decay(t, x):
        return -x

    def fall(t, x):
        return [x[1], -9.81]

    starts = iter(np.linspace(1.0, 2.0, 1_000_000).tolist())
    return {
        "solve, the same call": least(lambda: saltus.solve(decay, (0.0, 0.1), [1.0])),
        "solve, with a guard": least(
            lambda: saltus.solve(fall, (0.0, 0.6), [1.0, 0.0], events=[floor])
        ),
        "solve, another start": least(lambda: saltus.solve(decay, (0.0, 0.1), [next(starts)])),
        "solve, a new function": least(lambda: saltus.solve(lambda t, x: -x, (0.0, 0.1), [1.0])),
    }


def rows(ball):
    """All scenes; `ball` is the class of a ball over a floor, which is released at 10 m."""

    def high(system):
        return system.create_context().with_continuous_state([10.0, 0.0])

    traced, mixed = ball(0.9), branching(ball)
    return [
        row("ball, one bounce", traced, 1.5, high(traced)),
        row("thermostat", Thermostat(), 1.0),
        row("Kepler's orbit", Kepler(), 0.5),
        row("an ode that is called", Branching(), 0.1),
        row("a reset that is called", mixed, 1.5, high(mixed)),
    ]


def show(ball):
    """Prints the table, and returns it."""
    table, calls = rows(ball), solves()
    print(f"{'short runs [us]':28}{'core':>8}{'Simulator':>12}{'rows read':>12}{'simulate':>12}")
    for each in table:
        cells = (each[way] for way in ("Simulator", "its rows read", "simulate"))
        print(f"{each['scene']:28}{each['core']:8.1f}" + "".join(f"{c:+12.1f}" for c in cells))
    print("targets: Simulator +{Simulator:.0f}, simulate +{simulate:.0f}".format(**AIMS))
    for name, cost in calls.items():
        print(f"{name:28}{cost:8.1f}")
    print(f"target: the same call {AIMS['solve']:.0f} in all")
    return {"scenes": table, "solve": calls}
