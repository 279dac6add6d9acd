"""The pages of the course models, from their scene files and texts.toml.

`python docs/models/course/make.py [NAME ...]` writes pages and pictures, with `--text` pages only.
"""

import argparse
import collections
import re
import sys
import textwrap
from pathlib import Path

import numpy as np
import saltus
import tomllib

HERE = Path(__file__).parent
ROOT = HERE.parents[2]
SCENES = ROOT / "examples" / "scenes"
sys.path.insert(0, str(ROOT / "docs" / "site"))

from style import mark_events, plt, save, with_gaps  # noqa: E402

TEXTS = tomllib.loads((HERE / "texts.toml").read_text())
PROGRAM = """import saltus

results = saltus.load_scene("{name}.toml").simulate()
print(results.status, f"at t = {{results.time[-1]:.6g}}, {{len(results.events)}} events")
"""
TABLE = re.compile(r"^\[(.*)\]")
PARAMETER = re.compile(r"^(\w+) = ([^#]*?)(?:\s*#\s*(.*))?$")


def parameters(text):
    """Rows of a table: the parameters of a scene file, with the units and words of comments."""
    inside = False
    for line in text.splitlines():
        if table := TABLE.match(line):
            inside = table[1].endswith("parameters")
        elif inside and (found := PARAMETER.match(line)):
            unit, words = re.fullmatch(r"(?:\[([^\]]*)\])?,?\s*(.*)", found[3] or "").groups("")
            yield f"| `{found[1]}` | {found[2]} | {unit} | {words} |"


def events(results):
    """Rows of a table: each kind of event, how often it happened, and when first."""
    counts, first = collections.Counter(), {}
    for event in results.events:
        counts[event.name] += 1
        first.setdefault(event.name, event.time)
    for name, count in counts.items():
        yield f"| `{name}` | {count} | {first[name]:.5g} |"


def table(head, rows):
    rows = list(rows)
    lines = [f"| {' | '.join(head)} |", f"|{' --- |' * len(head)}", *rows]
    return "\n".join(lines) + "\n" if rows else ""


def page(name):
    """The Markdown of a model."""
    text = TEXTS[name]
    scene, script = ((SCENES / f"{name}.{end}").read_text() for end in ("toml", "py"))
    results = saltus.load_scene(SCENES / f"{name}.toml").simulate()
    equations = text["equations"].strip()
    said = f"{results.status} at t = {results.time[-1]:.6g}, {len(results.events)} events"
    parts = [
        f"# {text['heading']}",
        text["lead"],
        f"```python beside=examples/scenes\n{PROGRAM.format(name=name)}```",
        f"```text output\n{said}\n```",
        "From the shell:",
        f"```sh beside=examples/scenes\nsaltus run {name}.toml --plot {name}.svg\n```",
        f"![{text['heading']}: {alternative(text)}]({name}.svg)",
        f"![{text['heading']}, as a film]({name}.gif)" if (HERE / f"{name}.gif").exists() else "",
        f"$$\n\\begin{{aligned}}\n{equations}\n\\end{{aligned}}\n$$",
        "## What to see",
        text["see"].strip(),
        table(["event", "times", f"first [{text.get('unit', 's')}]"], events(results)),
        table(["parameter", "value", "unit", ""], parameters(scene)),
        "## Its law",
        f"{text['law']} A test compares it.\n"
        "Another compares the file with the script below to the last bit.",
        "## Source",
        text["source"],
        "## As a file",
        f"`examples/scenes/{name}.toml`; see [Scenes as files](../../scene_files.md) for its keys.",
        f"```toml\n{scene.strip()}\n```",
        "## In Python",
        f"`examples/scenes/{name}.py`",
        f"```python\n{script.strip()}\n```",
    ]
    return "\n\n".join(part.strip() for part in parts if part) + "\n"


def alternative(text):
    """What a picture shows, in words."""
    shown = [
        f"{p['y']} over {p['x']}" if "x" in p else " and ".join(p["signals"])
        for p in text["panels"]
    ]
    return ", ".join(shown)


def column(results, signal):
    name, entry = re.fullmatch(r"(\w+)(?:\[(\d+)\])?", signal).groups()
    values = np.asarray(results.outputs[name], float)
    return values if entry is None else values[:, int(entry)]


def window(results, panel):
    return panel.get("window", (results.time[0], results.time[-1]))


def in_plane(axis, results, panel):
    begin, end = window(results, panel)
    shown = (results.time >= begin) & (results.time <= end)
    axis.plot(*[column(results, panel[key])[shown] for key in "xy"])
    axis.set(xlabel=panel["x"], ylabel=panel["y"])


def over_time(axis, results, panel, unit):
    begin, end = window(results, panel)
    values = np.stack([column(results, signal) for signal in panel["signals"]], axis=1)
    for level in panel.get("levels", []):
        axis.axhline(level, color="0.75", lw=0.7)
    times, values = with_gaps(results, values)
    shown = ~(times < begin) & ~(times > end)  # with the gaps, whose times are not numbers
    lines = axis.plot(times[shown], values[shown])
    if len(lines) > 1:
        axis.legend(lines, panel["signals"], loc="best")
    mark_events(axis, results, begin, end)
    axis.set(xlim=(begin, end), ylabel=panel["label"], xlabel=f"time t [{unit}]")


def picture(name):
    """Panels over time above each other, those of a plane beside them."""
    text = TEXTS[name]
    scene = saltus.load_scene(SCENES / f"{name}.toml")
    results = scene.simulate(save_at=np.linspace(*scene.t_span, 2000), save_steps=True)
    planes = [panel for panel in text["panels"] if "x" in panel]
    rows = [panel for panel in text["panels"] if "x" not in panel]
    figure = plt.figure(figsize=(6.4, 0.9 + 1.25 * max(len(rows), 2)), layout="constrained")
    grid = figure.add_gridspec(len(rows), 2 if planes else 1)
    for k, panel in enumerate(rows):
        over_time(figure.add_subplot(grid[k, 0]), results, panel, text.get("unit", "s"))
    for axis, panel, below in zip(figure.axes, rows, rows[1:], strict=False):
        if window(results, panel) == window(results, below):
            axis.set_xlabel("")
    for panel in planes:
        in_plane(figure.add_subplot(grid[:, 1]), results, panel)
    figure.axes[0].set_title(textwrap.fill(scene.title, 44 if planes else 96))
    return figure


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("names", nargs="*", help="models; all if none is given")
    parser.add_argument("--text", action="store_true", help="pages without pictures")
    arguments = parser.parse_args()
    for name in arguments.names or TEXTS:
        (HERE / f"{name}.md").write_text(page(name))
        if not arguments.text:
            save(picture(name), HERE / f"{name}.svg")
        print(name, flush=True)


if __name__ == "__main__":
    main()
