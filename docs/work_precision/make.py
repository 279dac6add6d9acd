"""The chart of docs/work_precision.md: `python docs/work_precision/make.py`. Takes half a minute."""

from pathlib import Path

import saltus

FOLDER = Path(__file__).parent


def main():
    scene = saltus.scene("van-der-pol")
    methods = ["dopri5", "dop853", "adams", "bdf", "radau", "auto"]
    table = saltus.work_precision(scene, methods=methods, time_limit=3.0)
    table.plot(FOLDER / "van-der-pol.svg")
    print(table)


if __name__ == "__main__":
    main()
