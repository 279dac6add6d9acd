"""A bouncing ball from ready blocks: it comes to rest, the floor drops, it falls again.

Two integrators make velocity and height. Where the height is below the floor, a comparator resets
both: the height to the floor, the velocity to -e times itself.
"""

import argparse

import numpy as np
import saltus
from saltus.library import *


def make_diagram(e: float, drop_time: float, depth: float, g: float = 9.81) -> saltus.Diagram:
    builder = saltus.DiagramBuilder()
    v, y = (
        builder.add(Integrator(enable_reset=True, enable_external_reset=True, name=name))
        for name in ("velocity", "height")
    )
    weight = builder.add(Constant(-g, name="weight"))
    floor = builder.add(Step(0.0, -depth, step_time=drop_time, name="floor"))
    below = builder.add(Comparator("<", name="below"))
    rebound = builder.add(Gain(-e, name="rebound"))

    builder.connect(weight.output(), v.input("in"))
    builder.connect(v.output(), y.input("in"))

    builder.connect(y.output(), below.input(0))
    builder.connect(floor.output(), below.input(1))
    builder.connect(below.output(), v.input("reset_trigger"))
    builder.connect(below.output(), y.input("reset_trigger"))

    builder.connect(v.output(), rebound.input())
    builder.connect(rebound.output(), v.input("reset_value"))
    builder.connect(floor.output(), y.input("reset_value"))
    return builder.build()


def draw(results: saltus.Results, args: argparse.Namespace) -> None:
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(figsize=(8, 3), layout="constrained")
    axes.plot(results.time, results.outputs["height"], label="ball")
    axes.step(results.time, results.outputs["floor"], where="post", color="0.5", label="floor")
    axes.set(xlabel="time [s]", ylabel="height [m]", title=f"The floor drops, e = {args.e:g}")
    axes.legend()
    axes.grid(alpha=0.3)
    if args.save:
        figure.savefig(args.save, dpi=150)
    if args.show:
        plt.show()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--e", type=float, default=0.8, help="restitution (default: %(default)s)")
    parser.add_argument("--y0", type=float, default=1.0, help="[m] height (default: %(default)s)")
    parser.add_argument(
        "--drop-time",
        type=float,
        default=5.0,
        help="[s] when the floor drops (default: %(default)s)",
    )
    parser.add_argument("--end", type=float, default=8.0, help="[s] end (default: %(default)s)")
    parser.add_argument("--dot", action="store_true", help="print the diagram for Graphviz")
    parser.add_argument("--plan", action="store_true", help="say what is computed when")
    parser.add_argument("--save", metavar="FILE", help="write a picture")
    parser.add_argument("--show", action="store_true", help="open a picture")
    args = parser.parse_args()

    diagram = make_diagram(args.e, args.drop_time, depth=args.y0)
    height = diagram["height"]
    context = diagram.create_context()
    context = context.with_subcontext(height, context[height].with_continuous_state(args.y0))
    if args.dot:
        print(diagram.to_dot())
        return
    if args.plan:
        print(saltus.Simulator(diagram).describe())
    results = saltus.simulate(
        diagram,
        context,
        (0.0, args.end),
        recorded_signals={"height": height.output(), "floor": diagram["floor"].output()},
        save_at=np.linspace(0.0, args.end, 2001),
    )
    print(results)
    for event in results.events:
        if event.kind == "zeno_enter" and event.block == "height":
            print(f"at rest from t = {event.predicted:.12f} s")
        if event.kind == "zeno_release" and event.block == "height":
            print(f"falls again at t = {event.time:.12f} s")
    if args.save or args.show:
        draw(results, args)


if __name__ == "__main__":
    main()
