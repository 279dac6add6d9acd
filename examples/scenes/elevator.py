"""An elevator that is called to three floors; the file beside it in Python."""

from collections.abc import Callable
from typing import Any

import numpy as np
import saltus

WAITS, GOES_UP, GOES_DOWN, OPEN = 0, 1, 2, 3
HEIGHT, SPEED, PAUSE = 3.0, 1.5, 4.0  # [m], [m/s], [s]


class Elevator(saltus.LeafSystem):
    def __init__(self) -> None:
        super().__init__(name="elevator")
        self.declare_continuous_state(2, ode=self.ode)
        self.declare_discrete_state([0.0])
        self.declare_default_mode(WAITS)
        self.declare_output_port(lambda time, state: state.continuous_state[0], name="y")
        self.declare_output_port(lambda time, state: state.mode == OPEN, name="open")
        fire = {"at_start": "fire"}
        self.guard("rises", self.above, "rising", WAITS, GOES_UP, **fire)
        self.guard("sinks", self.below, "falling", WAITS, GOES_DOWN, **fire)
        self.guard("arrives_above", self.way, "falling", GOES_UP, OPEN, reset_map=self.stop)
        self.guard("arrives_below", self.way, "rising", GOES_DOWN, OPEN, reset_map=self.stop)
        self.guard("closes", self.paused, "rising", OPEN, WAITS)
        for name, time, floor in (
            ("to_four", 1.0, 4.0),
            ("to_one", 20.0, 1.0),
            ("to_two", 30.0, 2.0),
        ):
            self.declare_time_event(
                lambda time, state, floor=floor: state.with_discrete_state([floor]),
                times=[time], name=name,
            )  # fmt: skip

    def guard(
        self,
        name: str,
        function: Callable[..., Any],
        direction: str,
        begin: int,
        end: int,
        **how: Any,
    ) -> None:
        self.declare_zero_crossing(
            function, name=name, direction=direction, start_mode=begin, end_mode=end, **how
        )

    def ode(self, time: float, state: saltus.State) -> Any:
        up = np.where(state.mode == GOES_UP, 1.0, 0.0)
        down = np.where(state.mode == GOES_DOWN, 1.0, 0.0)
        return [SPEED * (up - down), np.where(state.mode == OPEN, 1.0, 0.0)]

    def way(self, time: float, state: saltus.State) -> Any:
        return HEIGHT * state.discrete_state[0] - state.continuous_state[0]

    def above(self, time: float, state: saltus.State) -> Any:
        return self.way(time, state) - 0.01

    def below(self, time: float, state: saltus.State) -> Any:
        return self.way(time, state) + 0.01

    def paused(self, time: float, state: saltus.State) -> Any:
        return state.continuous_state[1] - PAUSE

    def stop(self, time: float, state: saltus.State) -> saltus.State:
        return state.with_continuous_state([state.continuous_state[0], 0.0])


def run() -> saltus.Results:
    elevator = Elevator()
    return saltus.simulate(
        elevator, elevator.create_context(), (0.0, 50.0),
        rtol=1e-9, atol=1e-11, recorded_signals=["y", "open"],
    )  # fmt: skip


if __name__ == "__main__":
    print(run())
