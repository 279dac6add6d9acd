"""`WorkPrecision`: the rows of a work-precision report, to read, to save and to draw."""

from __future__ import annotations

import csv
import html
import json
import math
from collections.abc import Iterator, Sequence
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

from saltus.errors import ModelError
from saltus.report.fields import require_report

if TYPE_CHECKING:
    import pandas  # type: ignore[import-untyped,import-not-found,unused-ignore]
    from matplotlib.figure import Figure  # type: ignore[import-not-found,unused-ignore]

__all__ = ["WorkPrecision"]

FORMAT = "saltus work-precision 1"
# title, key and format of each column; a column without a known value is left out
COLUMNS = (
    ("method", "method", str),
    ("rtol", "rtol", "{:.0e}".format),
    ("max error", "error", "{:.1e}".format),
    ("event error", "event_error", "{:.1e}".format),
    ("off", "event_mismatch", str),
    ("depth", "penetration", "{:.1e}".format),
    ("drift", "invariant_drift", "{:.1e}".format),
    ("Zeno time", "accumulation_error", "{:.1e}".format),
    ("rest", "rest_error", "{:.1e}".format),
    ("release", "release_error", "{:.1e}".format),
    ("warm [s]", "seconds", "{:.2e}".format),
    ("cold [s]", "cold_seconds", "{:.2e}".format),
    ("steps", "steps", str),
    ("rhs", "right_hand_side_calls", str),
    ("guards", "guard_calls", str),
    ("status", "status", str),
)


class WorkPrecision(Sequence[dict[str, Any]]):
    """A row for each method at each tolerance, as a dict; unknown values are nan.

    Failed runs have rows too: 'status' says how they ended, 'message' why, and their 'seconds' is
    unknown. docs/work_precision.md explains each column. Made by `work_precision`.

    Parameters
    ----------
    data
        The content of the JSON of a report.

    Examples
    --------
    >>> table = saltus.work_precision(
    ...     saltus.scene("bouncing-ball"), methods=["dopri5"], rtols=[1e-4, 1e-8], least_time=0.0
    ... )
    >>> len(table), table.methods
    (2, ['dopri5'])
    >>> table[0]["event_error"] < 1e-3
    True
    >>> table.to_csv("ball.csv")
    >>> table.to_json("ball.json")
    >>> saltus.WorkPrecision.from_json("ball.json").rows == table.rows
    True
    """

    scene: str
    title: str
    t_span: tuple[float, float]
    """[s]"""
    growth: float
    """the factor by which the problem enlarges an error made on its way"""
    cold: str
    """the work in 'cold_seconds': 'plan and first run', for a ready scene also the system"""
    reference: dict[str, Any]
    """'kind' ('exact', 'stored' or 'run'), 'provenance', and of a run the 'bound' of its own error
    and the 'event_bound' [s]
    """
    environment: dict[str, Any]
    """'cpu', 'cores', 'compiler', 'build', 'sundials', 'saltus'"""
    orders: dict[str, float]
    """the visible order p of error ~ steps^-p by method; nan if none is visible"""
    rows: list[dict[str, Any]]

    def __init__(self, data: dict[str, Any]):
        self.scene, self.title = data["scene"], data["title"]
        self.t_span, self.growth = (data["begin"], data["end"]), data["growth"]
        self.cold = data["cold"]
        self.reference = _known(data["reference"])
        self.environment = data["environment"]
        self.orders = _known(data["orders"])
        self.rows = [_known(row) for row in data["rows"]]

    @classmethod
    def from_json(cls, source: str | PathLike[str]) -> WorkPrecision:
        """Reads the text from `to_json`, or from `--report --json` of an example.

        Parameters
        ----------
        source
            The text, or the path of it.

        Raises
        ------
        ModelError
            If it is anything else; the message names the field.
        """
        is_text = isinstance(source, str) and source.lstrip().startswith("{")
        try:
            data = json.loads(str(source) if is_text else Path(source).read_text(encoding="utf-8"))
        except (ValueError, RecursionError) as error:  # no UTF-8, no JSON, or nested without end
            raise ModelError(f"a report in JSON: {error}") from None
        found = data.get("format") if isinstance(data, dict) else type(data).__name__
        if found != FORMAT:
            raise ModelError(f"a report in JSON: expected format {FORMAT!r}, found {found!r}")
        require_report(data)
        return cls(data)

    def to_json(self, path: str | PathLike[str]) -> None:
        """Writes all of it, to the last bit; nan becomes null."""
        begin, end = self.t_span
        data = {
            "format": FORMAT, "scene": self.scene, "title": self.title, "begin": begin, "end": end,
            "growth": self.growth, "cold": self.cold, "reference": _null(self.reference),
            "environment": self.environment, "orders": _null(self.orders),
            "rows": [_null(row) for row in self.rows],
        }  # fmt: skip
        Path(path).write_text(json.dumps(data, indent=1, allow_nan=False) + "\n")

    def to_csv(self, path: str | PathLike[str]) -> None:
        """Lines of '# name: value' about the scene, the reference and the machine, then a line of
        names and one for each row. nan is left empty. `pandas.read_csv(path, comment="#")` reads
        it.
        """
        with open(path, "w", newline="") as file:
            file.write(f"# scene: {self.scene}\n")
            about = {f"reference {name}": value for name, value in self.reference.items()}
            for name, value in {**about, **self.environment}.items():
                file.write(f"# {name}: {json.dumps(_null({name: value})[name])}\n")
            writer = csv.DictWriter(file, list(self.rows[0]) if self.rows else [])
            writer.writeheader()
            for row in self.rows:
                writer.writerow({k: "" if v is None else v for k, v in _null(row).items()})

    def to_pandas(self) -> pandas.DataFrame:
        """A line for each row, a column for each key. Needs pandas.

        Examples
        --------
        >>> table = saltus.work_precision(
        ...     saltus.scene("bouncing-ball"), methods=["dopri5"], rtols=[1e-4, 1e-8],
        ...     least_time=0.0,
        ... )
        >>> list(table.to_pandas()["rtol"])
        [0.0001, 1e-08]
        """
        import pandas

        return pandas.DataFrame(self.rows)

    def plot(self, path: str | PathLike[str] | None = None) -> Figure:
        """A log-log chart of error (across) against run time (up), a line for each method.

        If the scene has events, a second chart beside it shows the error of event times. Failures
        are at the margin, with their reasons below. Needs matplotlib.

        Parameters
        ----------
        path
            The file to write (.svg, .png, ...); by default no file is written.

        Returns
        -------
        matplotlib.figure.Figure
            The chart.

        Examples
        --------
        >>> table = saltus.work_precision(
        ...     saltus.scene("bouncing-ball"), methods=["dopri5"], rtols=[1e-4, 1e-8],
        ...     least_time=0.0,
        ... )
        >>> figure = table.plot("ball.svg")
        """
        from saltus.report.chart import draw, save

        figure = draw(self)
        if path is not None:
            save(figure, path)
        return figure

    @property
    def methods(self) -> list[str]:
        """The values in the order of the rows."""
        return list(dict.fromkeys(row["method"] for row in self.rows))

    def __len__(self) -> int:
        return len(self.rows)

    def __getitem__(self, index: Any) -> Any:
        return self.rows[index]

    def __iter__(self) -> Iterator[dict[str, Any]]:
        return iter(self.rows)

    def _shown(self) -> list[list[str]]:
        """Lines of cells, titles first."""
        columns = []
        for title, key, show in COLUMNS:
            cells = ["-" if _unknown(row.get(key)) else show(row[key]) for row in self.rows]
            if any(cell != "-" for cell in cells):
                columns.append([title, *cells])
        return [list(line) for line in zip(*columns, strict=True)]

    def _head(self) -> str:
        begin, end = self.t_span
        kind, says = self.reference["kind"], self.reference["provenance"]
        return f"{self.scene}, t = {begin:g} to {end:g} s; errors against ({kind}): {says}"

    def _reasons(self) -> list[str]:
        return [
            f"{r['method']}, rtol {r['rtol']:.0e}: {r['message']}" for r in self if r["message"]
        ]

    def __repr__(self) -> str:
        lines = self._shown()
        widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
        table = ["  ".join(c.rjust(w) for c, w in zip(r, widths, strict=True)) for r in lines]
        return "\n".join([self._head(), *table, *self._reasons()])

    def _repr_html_(self) -> str:
        head, *rows = [[html.escape(cell) for cell in line] for line in self._shown() or [[]]]
        body = "".join(f"<tr><td>{'</td><td>'.join(row)}</td></tr>" for row in rows)
        reasons = "".join(f"<li>{html.escape(reason)}</li>" for reason in self._reasons())
        return (
            f"<p>{html.escape(self._head())}</p><table><thead><tr><th>{'</th><th>'.join(head)}</th>"
            f"</tr></thead><tbody>{body}</tbody></table>"
            + (f"<ul>{reasons}</ul>" if reasons else "")
        )


def _unknown(value: object) -> bool:
    return value is None or (isinstance(value, float) and math.isnan(value))


def _known(values: dict[str, Any]) -> dict[str, Any]:
    return {key: math.nan if value is None else value for key, value in values.items()}


def _null(values: dict[str, Any]) -> dict[str, Any]:
    return {key: None if _unknown(value) else value for key, value in values.items()}
