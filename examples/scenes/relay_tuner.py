"""A relay finds the period at which a loop oscillates; the file beside it in Python."""

import saltus
from saltus.library import Adder, Constant, Relay, TransferFunction


def run() -> saltus.Results:
    builder = saltus.DiagramBuilder()
    builder.add(
        Constant(0.0, name="wanted"),
        Adder("+-", name="error"),
        Relay(0.01, -0.01, 1.0, -1.0, initially_on=True, name="relay"),
        TransferFunction([1.0], [1.0, 3.0, 3.0, 1.0], name="plant"),
    )
    builder.connect("wanted.out", "error.in_0")
    builder.connect("plant.out", "error.in_1")
    builder.connect("error.out", "relay.in")
    builder.connect("relay.out", "plant.in")
    builder.export_output("plant.out", "y")
    builder.export_output("relay.out", "u")
    loop = builder.build()
    return saltus.simulate(loop, loop.create_context(), (0.0, 60.0), rtol=1e-9, atol=1e-11)


if __name__ == "__main__":
    print(run())
