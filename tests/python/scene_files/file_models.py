"""The models of examples/scenes, each as a file and as a script of Python."""

import importlib.util
import sys
from pathlib import Path

EXAMPLES = Path(__file__).parents[3] / "examples"
FOLDER = EXAMPLES / "scenes"
MODELS = sorted(path.stem for path in FOLDER.glob("*.py"))
FILES = sorted(FOLDER.glob("*.toml"))


def script(name, folder=FOLDER):
    """A script as a module."""
    spec = importlib.util.spec_from_file_location(f"example_{name}", folder / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module


def bits(results):
    """All that a run gave, as bytes and names."""
    names = [(event.time, event.name.rpartition(".")[2], event.kind) for event in results.events]
    outputs = {name: array.tobytes() for name, array in results.outputs.items()}
    context = results.context
    return (
        results.status, results.time.tobytes(), results.jump.tobytes(), outputs, names,
        context.continuous_state.tobytes(), context.discrete_state.tobytes(), list(context.modes),
    )  # fmt: skip
