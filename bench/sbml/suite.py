"""Runs cases of the SBML semantic test suite: a folder or a zip of them.

python bench/sbml/suite.py CASES [--method M,M] [--default-tolerances] [--roadrunner] [--list]

A case NNNNN is a folder with NNNNN-sbml-*.xml, NNNNN-settings.txt and NNNNN-results.csv. It passes
if |c - u| <= absolute + relative |c| at every time and variable, with c the given result. The cases
are not part of this project: github.com/sbmlteam/sbml-test-suite, LGPL 2.1.
"""

from __future__ import annotations

import argparse
import collections
import csv
import statistics
import sys
import tempfile
import time
import zipfile
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import saltus
import saltus.sbml


@dataclass
class Case:
    """One case: its model, what is asked, and the given results."""

    name: str
    model: Path
    settings: dict[str, str]
    titles: list[str]
    results: np.ndarray

    def listed(self, key: str) -> list[str]:
        return [one.strip() for one in self.settings.get(key, "").split(",") if one.strip()]

    def number(self, key: str) -> float:
        return float(self.settings[key])


@dataclass
class Outcome:
    """How a case ended: 'passed', 'refused' or 'wrong', and why."""

    case: str
    status: str
    reason: str = ""
    seconds: float = 0.0


def cases_of(folder: Path) -> Iterator[Case]:
    for settings in sorted(folder.rglob("*-settings.txt")):
        name = settings.name.split("-")[0]
        models = sorted(settings.parent.glob(f"{name}-sbml-*.xml"))
        if not models:
            continue
        lines = (line.partition(":") for line in settings.read_text().splitlines())
        said = {key.strip(): value.strip() for key, _, value in lines if key.strip()}
        if not said.get("steps") or not said.get("duration"):
            continue  # of flux balance: no time course
        with open(settings.parent / f"{name}-results.csv", newline="") as file:
            rows = [row for row in csv.reader(file) if row]
        titles = [title.strip() for title in rows[0]]
        table = np.array([[_number(text) for text in row] for row in rows[1:]])
        yield Case(name, models[-1], said, titles, table)


def _number(text: str) -> float:
    return float(text.strip().lower().replace("infinity", "inf") or "nan")


def is_flux_balance(case: Case) -> bool:
    return "/fbc/version" in case.model.read_text(errors="replace")


Run = Callable[[Case], np.ndarray]
"""the table of a case, time first"""


def saltus_run(**options: Any) -> Run:
    def run(case: Case) -> np.ndarray:
        return saltus.sbml.time_course(
            case.model,
            start=case.number("start"),
            duration=case.number("duration"),
            steps=int(case.number("steps")),
            variables=case.titles[1:],
            amount=case.listed("amount"),
            concentration=case.listed("concentration"),
            **options,
        )

    return run


def roadrunner_run() -> Run:
    import roadrunner

    roadrunner.Logger.setLevel(roadrunner.Logger.LOG_CRITICAL)

    def run(case: Case) -> np.ndarray:
        loaded = roadrunner.RoadRunner(str(case.model))
        loaded.integrator.relative_tolerance = 1e-9
        loaded.integrator.absolute_tolerance = 1e-12
        loaded.integrator.variable_step_size = False
        loaded.integrator.maximum_num_steps = 1_000_000
        species = {*loaded.model.getFloatingSpeciesIds(), *loaded.model.getBoundarySpeciesIds()}
        shown = [f"[{n}]" if n in species and n in case.listed("concentration") else n
                 for n in case.titles[1:]]  # fmt: skip
        loaded.selections = ["time", *shown]
        steps, begin = int(case.number("steps")), case.number("start")
        return np.array(loaded.simulate(begin, begin + case.number("duration"), steps + 1))

    return run


def outcome_of(case: Case, run: Run) -> Outcome:
    began = time.perf_counter()
    try:
        found = run(case)
    except Exception as error:
        return Outcome(case.name, "refused", f"{type(error).__name__}: {error}")
    seconds = time.perf_counter() - began
    wrong = difference(case, found)
    return Outcome(case.name, "wrong" if wrong else "passed", wrong, seconds)


def difference(case: Case, found: np.ndarray) -> str:
    """The place of the largest difference beyond the tolerances; '' for none."""
    if found.shape != case.results.shape:
        return f"{found.shape} numbers, expected {case.results.shape}"
    given = case.results
    allowed = case.number("absolute") + case.number("relative") * np.abs(given)
    with np.errstate(invalid="ignore"):
        good = (np.abs(given - found) <= allowed) | (given == found)
    good |= np.isnan(given) & np.isnan(found)
    good[:, 0] = True
    if good.all():
        return ""
    row, column = np.argwhere(~good)[0]
    return (
        f"{case.titles[column]} at {given[row, 0]:g}: {found[row, column]:.9g}, expected "
        f"{given[row, column]:.9g} ({np.count_nonzero(~good)} of {good.size})"
    )


def report(name: str, found: list[Outcome], shown: bool) -> str:
    """One row of the table; the cases that did not pass are printed if they are `shown`."""
    counts = collections.Counter(one.status for one in found)
    for one in found if shown else ():
        if one.status != "passed":
            print(f"  {one.case} {one.status}: {' '.join(one.reason.split())[:300]}")
    times = sorted(one.seconds for one in found if one.status == "passed") or [0.0]
    middle, late = statistics.median(times), times[int(0.95 * (len(times) - 1))]
    return (
        f"| {name} | {counts['passed']} | {counts['refused']} | {counts['wrong']} | "
        f"{1e3 * middle:.1f} | {1e3 * late:.1f} |"
    )


def runs_of(chosen: argparse.Namespace) -> dict[str, Run]:
    runs: dict[str, Run] = {}
    for method in chosen.method.split(","):
        runs[f"{method}, rtol 1e-9"] = saltus_run(ode_solver_method=method)
        if chosen.default_tolerances:
            runs[f"{method}, defaults"] = saltus_run(ode_solver_method=method, rtol=1e-6, atol=1e-8)
    if chosen.roadrunner:
        runs["libRoadRunner, rtol 1e-9"] = roadrunner_run()
    return runs


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("cases", type=Path, help="a folder or a zip of cases")
    parser.add_argument("--method", default="auto", help="methods, with commas between")
    parser.add_argument("--default-tolerances", action="store_true", help="also rtol 1e-6")
    parser.add_argument(
        "--roadrunner", action="store_true", help="libRoadRunner beside, if installed"
    )
    parser.add_argument("--list", action="store_true", help="the cases that did not pass, and why")
    parser.add_argument("--only", help="some cases, with commas between")
    chosen = parser.parse_args()
    with tempfile.TemporaryDirectory() as unpacked:
        folder = chosen.cases
        if folder.suffix == ".zip":
            with zipfile.ZipFile(folder) as archive:
                archive.extractall(unpacked)
            folder = Path(unpacked)
        cases = [case for case in cases_of(folder) if not is_flux_balance(case)]
        if chosen.only:
            cases = [case for case in cases if case.name in chosen.only.split(",")]
        rows = [
            report(name, [outcome_of(case, run) for case in cases], chosen.list)
            for name, run in runs_of(chosen).items()
        ]
    print(f"{len(cases)} time courses")
    print("| method | passed | refused | wrong | median [ms] | 95 % below [ms] |")
    print("| --- | ---: | ---: | ---: | ---: | ---: |")
    print("\n".join(rows))


if __name__ == "__main__":
    sys.exit(main())
