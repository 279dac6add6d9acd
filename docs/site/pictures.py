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


def draw(fence):
    with contextlib.redirect_stdout(io.StringIO()):
        exec(compile(fence.program, fence.where, "exec"), {"__name__": "__main__"})
    text = io.StringIO()
    plt.gcf().savefig(text, format="svg", metadata={"Date": None, "Creator": None})
    plt.close("all")
    fence.picture.parent.mkdir(exist_ok=True)
    fence.picture.write_text(re.sub(r"(\d\.\d\d)\d+", r"\1", text.getvalue()))


def main():
    os.chdir(tempfile.mkdtemp())  # programs may write files
    for fence in fences("python"):
        if fence.picture:
            draw(fence)
            print(os.path.relpath(fence.picture, ROOT), flush=True)


if __name__ == "__main__":
    main()
