"""`python -m saltus.report FILE.json ... --out DIR`: a chart of each report."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from saltus.errors import Error
from saltus.report import WorkPrecision


def main(arguments: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(
        prog="python -m saltus.report",
        description="Draws a chart of each work-precision report in JSON.",
    )
    parser.add_argument("files", nargs="+", type=Path, metavar="FILE.json")
    parser.add_argument(
        "--out", type=Path, help="folder of the charts; that of each file if not said"
    )
    parser.add_argument("--format", default="svg", help="svg, png, pdf; svg if not said")
    chosen = parser.parse_args(arguments)
    if chosen.out:
        chosen.out.mkdir(parents=True, exist_ok=True)
    for file in chosen.files:
        try:
            table = WorkPrecision.from_json(file)
        except (Error, OSError) as error:
            print(f"{file}: {error}", file=sys.stderr)
            return 2
        chart = (chosen.out or file.parent) / f"{file.stem}.{chosen.format}"
        table.plot(chart)
        print(chart)
    return 0


if __name__ == "__main__":
    sys.exit(main())
