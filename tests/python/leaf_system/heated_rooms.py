"""A room with units and names of modes, for the tests of these."""

import saltus


class Room(saltus.LeafSystem):
    """dT/dt = 30 K/h * mode - (T - 10 °C) / h; the outside wind does not change."""

    def __init__(self, name="room"):
        super().__init__(name=name)
        self.declare_continuous_state(
            [20.0, 1.0], ode=self.flow, names=["temperature", "wind"], units=["°C", "m/s"]
        )
        self.declare_default_mode("on", names=["off", "on"])
        self.declare_mode_output("heater")
        self.declare_continuous_state_output("all")
        for name, at, way, before, after in (
            ("warm", 21.0, "rising", "on", "off"),
            ("cold", 19.0, "falling", "off", "on"),
        ):
            self.declare_zero_crossing(
                lambda time, state, at=at: state.continuous_state[0] - at,
                name=name, direction=way, start_mode=before, end_mode=after,
            )  # fmt: skip

    def flow(self, time, state):
        return [30.0 * state.mode - (state.continuous_state[0] - 10.0), 0.0]


def run(**options):
    return saltus.simulate(Room(), (0.0, 1.0), **options)


def house(depth=1):
    system = Room()
    for level in range(depth):
        builder = saltus.DiagramBuilder()
        builder.add(system)
        inner = system.name
        builder.export_output(f"{inner}.heater", "heater")
        builder.export_output(f"{inner}.temperature", "temperature")
        system = builder.build(f"level_{level}")
    return system
