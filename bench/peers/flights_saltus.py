"""Saltus on the flights, from Python: a simulator that is used again, with traced callbacks."""

import sys

import numpy as np
import saltus
import saltus.jit
from common import main
from flights import FLIGHTS

DIRECTIONS = {
    -1: "positive_then_non_positive", 0: "crosses_zero", 1: "negative_then_non_negative"
}  # fmt: skip


class Flight(saltus.LeafSystem):
    def __init__(self, scene):
        super().__init__(name="flight")
        self.declare_continuous_state(
            scene.start, ode=lambda t, s: scene.flow(np, t, s.continuous_state, s.mode)
        )
        self.declare_default_mode(scene.mode)
        for i, guard in enumerate(scene.guards):
            self.add(guard, f"guard{i}")

    def add(self, guard, name):
        more = {} if guard.mode is None else {"start_mode": guard.mode, "end_mode": 1 - guard.mode}

        def reset(t, state):
            return state.with_continuous_state(guard.reset(np, t, state.continuous_state)[0])

        self.declare_zero_crossing(
            lambda t, s: guard.g(np, t, s.continuous_state), name=name,
            direction=DIRECTIONS[guard.direction],
            reset_map=reset if guard.reset else None, **more,
        )  # fmt: skip


def runner(method):
    def make(scene, rtol):
        flight = Flight(scene)
        simulator = saltus.Simulator(
            flight, ode_solver_method=method, rtol=rtol, atol=rtol * scene.atol, save_steps=False,
            machine_code="always" if saltus.jit.is_installed() else "never",
        )  # fmt: skip
        start = flight.create_context()

        def run():
            simulator.initialize(start)
            simulator.advance_to(scene.end)
            results = simulator.results
            return results.events, results.context

        run()  # heyoka compiles before its first run too, always

        def answered():
            events, context = run()
            return [e.time for e in events], context.continuous_state

        answered.timed = run
        return answered

    return make


if __name__ == "__main__":
    names = sys.argv[1:] or list(FLIGHTS)
    methods = {method: runner(method) for method in ("taylor", "dop853", "dopri5")}
    main("Saltus", methods, {name: FLIGHTS[name] for name in names})
