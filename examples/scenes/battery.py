"""A battery under a pulsing load; the file beside it in Python."""

import numpy as np
import saltus
from saltus.library import Adder, Gain, HitCrossing, Integrator, LookupTable1d, Pulse

CHARGE = [0.0, 0.05, 0.1, 0.3, 0.5, 0.7, 0.9, 1.0]
VOLTAGE = [2.8, 3.2, 3.4, 3.6, 3.7, 3.85, 4.05, 4.2]  # [V]


def run() -> saltus.Results:
    builder = saltus.DiagramBuilder()
    builder.add(
        Pulse(5.0, period=600.0, name="load"),
        Gain(-1 / (3600 * 2.5), name="used"),
        Integrator(1.0, enable_limits=True, lower_limit=0.0, upper_limit=1.0, name="charge"),
        Gain(0.05, name="drop"),
        Adder("+-", name="voltage"),
        HitCrossing(3.4, "positive_then_non_positive", name="low"),
        LookupTable1d(CHARGE, VOLTAGE, name="open"),
    )
    for source, ends in (
        ("load.out", ("used.in", "drop.in")),
        ("used.out", ("charge.in",)),
        ("charge.out", ("open.in",)),
        ("open.out", ("voltage.in_0",)),
        ("drop.out", ("voltage.in_1",)),
        ("voltage.out", ("low.in",)),
    ):
        for end in ends:
            builder.connect(source, end)
    builder.export_output("voltage.out", "voltage")
    builder.export_output("charge.out", "charge")
    battery = builder.build()
    return saltus.simulate(
        battery, battery.create_context(), (0.0, 3000.0),
        rtol=1e-8, atol=1e-10, save_at=np.linspace(0.0, 3000.0, 3001), save_steps=False,
    )  # fmt: skip


if __name__ == "__main__":
    print(run())
