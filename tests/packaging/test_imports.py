"""No circle of imports in the Python package; a late import is in the table, with its reason."""

import ast
import functools
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2] / "python"
LATE = {
    ("saltus._engine", "saltus.jit"): "an option that most runs leave alone",
    ("saltus.ensemble.executors", "saltus.ensemble.pools"): "loads Python's machinery of processes",
    (
        "saltus.cli.new_scene",
        "saltus.scene_files",
    ): "loads parsers, which other commands leave alone",
    (
        "saltus.scenes",
        "saltus.scene_files",
    ): "loads parsers, which a scene of the shelf leaves alone",
    ("saltus.callbacks.callbacks", "saltus.tracing"): "a system without callbacks needs no tracer",
    ("saltus.callbacks.function", "saltus.tracing"): "a system without callbacks needs no tracer",
    ("saltus.callbacks.search", "saltus.tracing"): "a system without callbacks needs no tracer",
    ("saltus.cli.scene_of", "saltus.sbml"): "loads libsbml, which other scenes leave alone",
    ("saltus.differentiable.jax_function", "saltus.differentiable.jax_run"): "loads JAX",
    ("saltus.differentiable.torch_function", "saltus.differentiable.torch_run"): "loads PyTorch",
    ("saltus.jit.library", "saltus.jit.compiler"): "loads llvmlite",
    ("saltus.report.table", "saltus.report.chart"): "loads matplotlib",
    ("saltus.library", "saltus.library.called"): "answers names that are wrong",
    ("saltus._porting", "saltus.parameters.noted"): "most blocks are given numbers",
    ("saltus.leaf_system.values", "saltus.parameters.noted"): "most blocks are given numbers",
    ("saltus.diagram.builder", "saltus.parameters.shared"): "most diagrams have no parameters",
    ("saltus.parameter", "saltus.tracing.numbers"): "most diagrams have no parameters",
    ("saltus.ports", "saltus._evaluate"): "a system has ports, and these are evaluated with it",
    ("saltus.linearization.linear", "saltus.linearization.step"): "step responses, rarely wanted",
    ("saltus.cli.view_scene", "saltus.drawings.of_scene"): "loads films, as other commands do not",
    ("saltus.cli.view_scene", "saltus.results.tables"): "advice for a missing library",
    ("saltus.cli.view_scene", "saltus.simulation.simulate"): "other commands run nothing",
    ("saltus.cli.view_scene", "saltus.viewing.view"): "loads pages, as other commands do not",
    ("saltus.ensemble.executors", "saltus.ensemble.store"): "an option most sweeps leave alone",
    ("saltus.ensemble.executors", "saltus.ensemble.stored"): "an option most sweeps leave alone",
    ("saltus.ensemble.job", "saltus.ensemble.fingerprint"): "only stores need it",
    ("saltus.cli.sweep_runs", "saltus.ensemble.fingerprint"): "only stores need it",
    ("saltus.ensemble.heat_map", "saltus.results.charts.by_plotly"): "loads plotly",
    ("saltus.results.charts", "saltus.results.charts.phase"): "loads matplotlib",
    ("saltus.results.charts", "saltus.results.charts.raster"): "loads matplotlib",
    ("saltus.results.charts", "saltus.results.charts.section"): "loads matplotlib",
    ("saltus.results.charts", "saltus.results.charts.signals"): "loads matplotlib",
    ("saltus.results.charts", "saltus.results.charts.signals_plotly"): "loads plotly",
    ("saltus.results.charts", "saltus.results.charts.zeno"): "loads matplotlib",
    ("saltus.results.rows", "saltus.results.islands"): "rows of islands, which few runs have",
    (
        "saltus.results.outcome",
        "saltus.results.outside",
    ): "explains a failure, which most runs lack",
    ("saltus.results.outcome", "saltus.results.text"): "prints, which most runs do not",
    ("saltus.results.event_pictures", "saltus.results.charts"): "loads matplotlib",
    ("saltus.results.films", "saltus.results.animation"): "loads films",
    ("saltus.results.films", "saltus.viewing"): "loads pages",
    ("saltus.results.pictures", "saltus.results.charts"): "loads matplotlib",
    ("saltus.viewing.view", "saltus.drawings.of_scene"): "loads matplotlib",
    ("saltus._porting", "saltus.library.ported"): "wanted for arguments of other tools only",
    ("saltus.system.system", "saltus._evaluate"): "reads contexts, which are those of systems",
    ("saltus.system.drawn", "saltus._picture"): "loads subprocess, for Graphviz",
    ("saltus.system.drawn", "saltus._tree"): "reads the blocks of a diagram, which is a system",
    ("saltus.system.system", "saltus._start_values"): "most contexts have the usual values",
}
"""(module, what a function of it imports) -> why this waits until the function is called"""
ROOMS = {
    "saltus.tracing.numbers": {"saltus.tracing.refusal"},
    "saltus.tracing.sandbox": {"saltus.tracing.numbers", "saltus.tracing.refusal"},
    "saltus.tracing.effects": {"saltus.tracing.sandbox"},
}
"""folder with a face -> what its modules may import from outside the folder"""


def module_name(path):
    parts = path.relative_to(ROOT).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


MODULES = {module_name(path): path for path in sorted((ROOT / "saltus").rglob("*.py"))}


def imported(node):
    """The modules of the package that one import statement names."""
    if isinstance(node, ast.Import):
        return {alias.name for alias in node.names if alias.name.split(".")[0] == "saltus"}
    if not isinstance(node, ast.ImportFrom) or (node.module or "").split(".")[0] != "saltus":
        return set()
    names = {f"{node.module}.{alias.name}" for alias in node.names}
    return {name if name in {"saltus._core", *MODULES} else node.module for name in names}


def imports(tree, late=False):
    """(module, whether a function imports it), but for those that only a type checker reads."""
    for node in ast.iter_child_nodes(tree):
        if isinstance(node, ast.If) and "TYPE_CHECKING" in ast.dump(node.test):
            continue
        yield from ((name, late) for name in imported(node))
        yield from imports(node, late or isinstance(node, (ast.FunctionDef, ast.Lambda)))


IMPORTS = {name: set(imports(ast.parse(path.read_text()))) for name, path in MODULES.items()}


def test_there_is_no_circle():
    early = {
        name: {module for module, late in found if not late and module in MODULES}
        for name, found in IMPORTS.items()
    }
    assert sum(map(len, early.values())) > 100  # the reading of imports works
    try:
        TopologicalSorter(early).prepare()
    except CycleError as error:
        pytest.fail(" imports ".join(reversed(error.args[1])))


def test_functions_import_only_what_the_table_says():
    late = {(name, module) for name, found in IMPORTS.items() for module, late in found if late}
    assert late == set(LATE)


@pytest.mark.parametrize("room", ROOMS)
def test_a_room_is_entered_by_its_face_and_reads_only_what_it_may(room):
    inside = {name for name in MODULES if name.startswith(f"{room}.")}
    assert inside
    entered = [
        f"{name} imports {module}"
        for name, found in IMPORTS.items()
        for module, _ in found
        if module in inside and name not in inside | {room}
    ]
    reads = [
        f"{name} imports {module}"
        for name in inside
        for module, _ in IMPORTS[name]
        if module not in inside | {room} | ROOMS[room]
    ]
    assert not entered + reads


def test_every_module_says_what_it_has_for_others():
    """`__all__` of it has every name that another module imports, and no private one is."""
    private = [
        f"{name} imports {node.module}.{alias.name}"
        for name, path in MODULES.items()
        for node in ast.walk(ast.parse(path.read_text()))
        if isinstance(node, ast.ImportFrom) and node.module in MODULES
        for alias in node.names
        if f"{node.module}.{alias.name}" not in {"saltus._core", *MODULES}
        and alias.name not in exported(node.module)
    ]
    assert not private, "\n".join(private)


@functools.cache
def exported(module):
    """The names in `__all__` of a module."""
    for node in ast.parse(MODULES[module].read_text()).body:
        targets = node.targets if isinstance(node, ast.Assign) else []
        if any(isinstance(t, ast.Name) and t.id == "__all__" for t in targets):
            return ast.literal_eval(node.value)
    return []
