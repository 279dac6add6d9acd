"""Draws the pictures that fences of the documents promise: `python docs/site/pictures.py`."""

import contextlib
import io
import os
import re
import tempfile

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt
from snippets import ROOT, fences

plt.rcParams.update(
    {
        "figure.constrained_layout.use": True,
        "axes.spines.right": False,
        "axes.spines.top": False,
        "figure.figsize": (6.4, 3.0),
        "font.size": 9,
        "legend.frameon": False,
        "savefig.facecolor": "white",
        "svg.fonttype": "none",  # words stay words
        "svg.hashsalt": "saltus",  # the same bits each time it is drawn
    }
)


def run(fence):
    values = {"__name__": "__main__"}
    with contextlib.redirect_stdout(io.StringIO()):
        exec(compile(fence.program, fence.where, "exec"), values)
    return values


def figure(fence):
    run(fence)
    text = io.StringIO()
    plt.gcf().savefig(text, format="svg", metadata={"Date": None, "Creator": None})
    return re.sub(r"(\d\.\d\d)\d+", r"\1", text.getvalue())


def drawing(fence):
    return run(fence)["system"]._repr_svg_()  # None where Graphviz is not installed


def animation(fence, path):
    """A GIF of the `animation` that the fence makes, small enough for a page."""
    run(fence)["animation"].save(path, dpi=64)


def main():
    os.chdir(tempfile.mkdtemp())  # programs may write files
    for fence in fences("python"):
        for flag, draw in (("picture", figure), ("drawing", drawing)):
            path = fence.file(flag)
            text = draw(fence) if path else None
            plt.close("all")
            if text:
                path.write_text(text)
                print(os.path.relpath(path, ROOT), flush=True)
        if path := fence.file("animation"):
            animation(fence, path)
            plt.close("all")
            print(os.path.relpath(path, ROOT), flush=True)


if __name__ == "__main__":
    main()
