"""docs/cpp.md lists the names that the two languages do not share, and no others."""

import dataclasses
import inspect
import re
import sys
from pathlib import Path

import pytest
import saltus

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "docs" / "site"))

import cpp_reference  # noqa: E402  a page of the site reads the headers, and so does this test

CLASS = r"(?:struct|class) {}\b[^;{{]*\{{(.*?)^\}};"
BRACES = re.compile(r"\{[^{}]*\}")


def declarations(header, name):
    """The statements in the public or protected part of a class, without comments."""
    text = cpp_reference.digest((ROOT / "include" / "saltus" / header).read_text())
    text = re.sub(r"//[^\n]*|\b(public|protected):", "", text)
    body = re.search(CLASS.format(name), text, re.M | re.S)[1]
    while BRACES.search(body):  # initializers, and the members of inner classes
        body = BRACES.sub("", body)
    body = re.sub(r"<[^<>;]*>", "", re.sub(r"<[^<>;]*>", "", body))  # arguments of templates
    return [" ".join(statement.split()) for statement in body.split(";") if statement.strip()]


def methods(header, name):
    """The names of the member functions of a class, but for constructors and operators."""
    found = {
        call[1]
        for statement in declarations(header, name)
        if (call := re.search(r"(\w+)\(", statement)) and "operator" not in statement
    }
    return found - {name}


def members(header, name):
    """The names of the data members of a struct."""
    found = set()
    for statement in declarations(header, name):
        plain = re.split(r"\s=", statement)[0]
        if "(" not in plain and not re.match(r"using |enum |struct |class ", plain):
            found.update(part.split()[-1] for part in plain.split(","))
    return found


def public(cls):
    """The public names that a class has from this package."""
    bases = [base for base in cls.__mro__ if base.__module__.split(".")[0] == "saltus"]
    return {name for base in bases for name in vars(base) if not name.startswith("_")}


def declared(cls):
    return {name for name in public(cls) if name.startswith("declare_")}


def arguments(method):
    return set(inspect.signature(method).parameters) - {"self"}


def parameters(function):
    """The arguments that a C++ function takes as options: not the system, nor the context."""
    found = inspect.signature(function).parameters.values()
    named = {p.name for p in found if p.kind is not inspect.Parameter.VAR_KEYWORD}
    return named - {"system", "context"}


def fields_of(cls):
    """The public fields and methods of a dataclass."""
    return {name for name in public(cls) | set(cls.__annotations__) if not name.startswith("_")}


def blocks():
    headers = (ROOT / "include" / "saltus" / "library").glob("*.hpp")
    texts = [header.read_text() for header in headers]
    base = r"(?:LeafSystem|detail::SampledSystem)"
    pattern = re.compile(rf"^class (\w+)(?: final)? : public {base}", re.M)
    return {name for text in texts for name in pattern.findall(text)} - {"SampledSystem"}


Leaf = saltus.LeafSystem
PAIRS = {
    "LeafSystem": (
        {n for n in methods("model/leaf_system.hpp", "LeafSystem") if n.startswith("declare_")},
        declared(Leaf),
    ),
    "declare_continuous_state": (
        members("model/leaf_system.hpp", "ContinuousState"),
        arguments(Leaf.declare_continuous_state),
    ),
    "declare_input_port": (
        members("model/port.hpp", "InputDeclaration"),
        arguments(Leaf.declare_input_port),
    ),
    "declare_output_port": (
        members("model/port.hpp", "OutputDeclaration"),
        arguments(Leaf.declare_output_port),
    ),
    "declare_zero_crossing": (
        members("model/event.hpp", "ZeroCrossing"),
        arguments(Leaf.declare_zero_crossing),
    ),
    "declare_relation": (
        members("model/event.hpp", "Relation"),
        arguments(Leaf.declare_relation),
    ),
    "declare_edge_reset": (
        members("model/event.hpp", "EdgeReset"),
        arguments(Leaf.declare_edge_reset),
    ),
    "declare_event_input": (
        members("model/event_port.hpp", "EventInputDeclaration"),
        arguments(Leaf.declare_event_input),
    ),
    "declare_time_event": (
        members("model/event.hpp", "TimeEvent"),
        arguments(Leaf.declare_time_event),
    ),
    "DiagramBuilder": (
        methods("model/diagram_builder.hpp", "DiagramBuilder"),
        public(saltus.DiagramBuilder),
    ),
    "Context": (methods("model/context.hpp", "Context"), public(saltus.Context)),
    "library": (blocks(), set(saltus.library.__all__)),
    "SimulatorOptions": (
        members("simulation/options.hpp", "SimulatorOptions"),
        {field.name for field in dataclasses.fields(saltus.SimulatorOptions)},
    ),
    "Simulator": (methods("simulation/simulator.hpp", "Simulator"), public(saltus.Simulator)),
    "Results": (
        members("simulation/results.hpp", "Results") | methods("simulation/results.hpp", "Results"),
        public(saltus.Results) | set(saltus.Results.__annotations__),
    ),
    "Event": (
        members("simulation/event_log.hpp", "Event"),
        set(saltus.Event._fields),
    ),
    "trim": (members("analysis/trim.hpp", "TrimOptions"), parameters(saltus.trim)),
    "equilibria": (
        members("analysis/equilibria.hpp", "EquilibriaOptions"),
        parameters(saltus.equilibria),
    ),
    "OperatingPoint": (
        members("analysis/trim.hpp", "OperatingPoint")
        | methods("analysis/trim.hpp", "OperatingPoint"),
        fields_of(saltus.OperatingPoint),
    ),
    "periodic_orbit": (
        members("analysis/periodic_orbit.hpp", "PeriodicOrbitOptions"),
        parameters(saltus.periodic_orbit),
    ),
    "PeriodicOrbit": (
        members("analysis/periodic_orbit.hpp", "PeriodicOrbit")
        | methods("analysis/periodic_orbit.hpp", "PeriodicOrbit"),
        fields_of(saltus.PeriodicOrbit),
    ),
    "period_map": (
        members("analysis/period_map.hpp", "PeriodMapOptions"),
        parameters(saltus.period_map),
    ),
    "PeriodMap": (
        members("analysis/period_map.hpp", "PeriodMap")
        | methods("analysis/period_map.hpp", "PeriodMap"),
        fields_of(saltus.PeriodMap),
    ),
    "lyapunov": (
        members("analysis/lyapunov.hpp", "LyapunovOptions"),
        parameters(saltus.lyapunov),
    ),
    "LyapunovSpectrum": (
        members("analysis/lyapunov.hpp", "LyapunovSpectrum")
        | methods("analysis/lyapunov.hpp", "LyapunovSpectrum"),
        fields_of(saltus.LyapunovSpectrum),
    ),
    "fit": (members("analysis/fit.hpp", "FitOptions"), parameters(saltus.fit)),
    "FitResult": (
        members("analysis/fit.hpp", "FitResult") | methods("analysis/fit.hpp", "FitResult"),
        fields_of(saltus.FitResult),
    ),
    "Experiment": (
        members("analysis/experiment.hpp", "Experiment"),
        {field.name for field in dataclasses.fields(saltus.Experiment)},
    ),
    "Free": (
        members("analysis/free_value.hpp", "FreeValue"),
        {field.name for field in dataclasses.fields(saltus.Free)},
    ),
    "Statistics": (
        members("simulation/results.hpp", "Statistics")
        | members("solver/statistics.hpp", "SolverStatistics"),
        {field.name for field in dataclasses.fields(saltus.Statistics)},
    ),
}


def table():
    """{subject: (names in C++, names in Python)} of the table in docs/cpp.md."""
    page = (ROOT / "docs" / "cpp.md").read_text()
    rows = page[page.index("| of | C++ | Python |") :].split("\n\n")[0].splitlines()[2:]
    found = {}
    for row in rows:
        of, cpp, python = (re.findall(r"`([^`]+)`", cell) for cell in row.split("|")[1:4])
        names = found.setdefault(of[0], (set(), set()))
        names[0].update(cpp)
        names[1].update(python)
    return found


@pytest.mark.parametrize("of", PAIRS)
def test_the_table_names_what_differs(of):
    cpp, python = PAIRS[of]
    assert cpp and python
    listed = table().get(of, (set(), set()))
    assert (cpp - python, python - cpp) == listed


def test_the_table_is_of_nothing_else():
    assert table().keys() <= PAIRS.keys()
