"""Two spiking cells that excite and inhibit each other; the file beside it in Python."""

from typing import Any

import saltus

TAU = 0.02  # [s]
EXCITATION, INHIBITION = 0.6, 0.1
TRAVEL = 0.002  # [s] of a spike from the first cell to the second


class Cell(saltus.LeafSystem):
    """v' = current - v / TAU, reset to 0 at the threshold 1; each delivery adds its weight to v."""

    def __init__(self, name: str, current: float) -> None:
        super().__init__(name=name)
        self.declare_dynamic_parameter("current", current)  # [1/s]
        self.declare_continuous_state([0.0], ode=self.ode)
        self.declare_discrete_state([0.0])
        self.declare_output_port(lambda t, s, current: s.continuous_state[0], name="potential")
        self.declare_output_port(lambda t, s, current: s.discrete_state[0], name="spikes")
        self.declare_zero_crossing(self.threshold, self.reset, name="fire", direction="rising")
        self.declare_event_input(self.receive, name="synapse")

    def ode(self, time: float, state: saltus.State, current: float) -> Any:
        return [current - state.continuous_state[0] / TAU]

    def threshold(self, time: float, state: saltus.State, current: float) -> Any:
        return state.continuous_state[0] - 1.0

    def reset(self, time: float, state: saltus.State, current: float) -> Any:
        return state.with_continuous_state([0.0]).with_discrete_state(
            [state.discrete_state[0] + 1.0]
        )

    def receive(self, time: float, state: saltus.State, weight: float, current: float) -> Any:
        return state.with_continuous_state([state.continuous_state[0] + weight])


def run() -> saltus.Results:
    builder = saltus.DiagramBuilder()
    builder.add(Cell("first", 100.0), Cell("second", 45.0))
    builder.connect_event("first.fire", "second.synapse", weight=EXCITATION, delay=TRAVEL)
    builder.connect_event("second.fire", "first.synapse", weight=-INHIBITION)
    recorded = {"first": "first.potential", "second": "second.potential"}
    recorded |= {name: name for name in ("first.spikes", "second.spikes")}
    return saltus.simulate(
        builder.build(), time_span=(0.0, 0.06),
        rtol=1e-9, atol=1e-11, recorded_signals=recorded,
    )  # fmt: skip


if __name__ == "__main__":
    print(run())
