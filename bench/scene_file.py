"""Measures a scene file of a thousand mixed blocks: to read it, to make the plan, to run it.

    python bench/scene_file.py [FILE ...]

Each file, or a wide diagram that is made here; medians of seven, in processor time. A scene that
uses no file reads none: the last line says which modules `import saltus` has loaded of those that
read files.
"""

import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import saltus

TARGET = 1.0  # [s] to read and compile a thousand blocks
GROUP = {
    "a": '"Gain", gain = "k * {i}"',
    "b": '"Integrator", initial_state = {i}',
    "c": '"Saturate", lower_limit = -1, upper_limit = {i}.5',
    "d": '"Sine", frequency = {i}.5',
    "e": '"LookupTable1d", input_array = [0, 1, {i}.5], output_array = [0, 2, 1]',
    "f": '"Adder", operators = "+-"',
    "g": '"TransferFunction", num = [1.0], den = [1.0, {i}.5]',
    "h": '"Relay", on_threshold = 0.5, off_threshold = -0.5',
}
WIRES = ["t -> a{i}", "a{i} -> b{i}", "b{i} -> c{i}", "c{i} -> f{i}.in_0", "d{i} -> f{i}.in_1",
         "f{i} -> g{i}", "g{i} -> h{i}", "b{i} -> e{i}"]  # fmt: skip


def wide(groups):
    """A diagram of so many groups of eight blocks, as text."""
    wires = ",\n".join(f'"{w.format(i=i)}"' for i in range(2, groups + 2) for w in WIRES)
    blocks = "\n".join(
        f"{name}{i} = {{ block = {words.format(i=i)} }}"
        for i in range(2, groups + 2)
        for name, words in GROUP.items()
    )
    return (
        f'version = 1\nwires = [{wires}]\n[parameters]\nk = 0.1\n[blocks]\nt = {{ block = "Clock" }}\n'
        f'{blocks}\n[outputs]\ny = "g2.out"\n[run]\nuntil = 1.0\n'
    )


def measured(path):
    """[s] to read a file, to make its plan, to run it."""
    start = time.process_time()
    scene = saltus.load_scene(path)
    read = time.process_time()
    simulator = saltus.Simulator(scene.system, scene.options).initialize(scene.context)
    planned = time.process_time()
    simulator.advance_to(1.0)
    return len(scene.system.blocks), read - start, planned - read, time.process_time() - planned


def main():
    with tempfile.TemporaryDirectory() as folder:
        own = Path(folder) / "wide.toml"
        own.write_text(wide(125))
        print("blocks   read    plan     run  [s]")
        for path in sys.argv[1:] or [own]:
            rows = [measured(path) for _ in range(7)]
            read, plan, run = (statistics.median(column) for column in list(zip(*rows))[1:])
            verdict = "" if read + plan < TARGET else f"  missed: {TARGET} s to read and compile"
            print(f"{rows[0][0]:6d}  {read:.3f}   {plan:.3f}   {run:.3f}{verdict}")
    code = "import sys, saltus; print([m for m in sys.modules if 'scene_files' in m or m == 'tomllib'])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    print("loaded by `import saltus` alone:", done.stdout.strip())


if __name__ == "__main__":
    main()
