"""A scene of the shelf, drawn: jumps are gaps, Zeno holds are shaded, events are ticks."""

import argparse
from pathlib import Path

import saltus


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument(
        "scene", nargs="?", default="bouncing-ball", choices=saltus.shelf(), metavar="SCENE"
    )
    parser.add_argument("--out", type=Path, default=Path("plot"), help="folder of the pictures")
    args = parser.parse_args()

    scene = saltus.scene(args.scene)
    results = scene.simulate(dense_output=True)
    print(scene.title)
    print(results)

    import matplotlib.pyplot as plt

    args.out.mkdir(parents=True, exist_ok=True)
    results.plot()
    plt.gcf().savefig(args.out / f"{args.scene}.png", dpi=150)
    (args.out / f"{args.scene}.dot").write_text(scene.system.to_dot())  # for Graphviz
    print(f"see {args.out}/{args.scene}.png; dot -Tsvg {args.out}/{args.scene}.dot draws the model")


if __name__ == "__main__":
    main()
