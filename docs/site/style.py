"""The style of the pictures of models, that of `results.plot()`: gaps at jumps, ticks, shaded holds."""

import io
import re

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt
import numpy as np
from saltus.results.charts.chart import COLOURS

HOLD = {"color": "0.5", "alpha": 0.13, "lw": 0}  # as plot() draws it
TAG = re.compile(r"<[^>]*>")
DIGITS = re.compile(r"(\d\.\d\d)\d+")
plt.rcParams.update(
    {
        "font.size": 8,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "axes.titlesize": 8,
        "axes.titlelocation": "left",
        "axes.prop_cycle": plt.cycler(color=COLOURS),
        "lines.linewidth": 1.0,
        "legend.frameon": False,
        "svg.fonttype": "none",  # words stay words
        "svg.hashsalt": "saltus",  # the same bits each time it is drawn
        "savefig.facecolor": "white",
    }
)


def with_gaps(results, values):
    """Times and values with a row of NaN at each jump, over which no line is drawn."""
    jumps = 1 + np.flatnonzero(np.diff(results.jump) > 0)
    jumps = [j for j in jumps if not np.allclose(values[j], values[j - 1], rtol=1e-6, atol=0)]
    times = np.insert(results.time, jumps, np.nan)
    return times, np.insert(values, jumps, np.nan, axis=0)


def mark_events(axis, results, begin=-np.inf, end=np.inf):
    """A tick on the time axis for each event between two times, holds shaded."""
    events = results.events
    times = np.unique(
        [round(e.time, 12) for e in events if e.kind in ("zero_crossing", "terminal")]
    )
    times = times[(begin <= times) & (times <= end)]
    if len(times):
        across = axis.get_xaxis_transform()  # x in seconds, y in parts of the axes
        axis.vlines(times, 0.0, 0.05, transform=across, color="0.35", lw=0.7, zorder=1)
    entered = [e.time for e in events if e.kind == "zeno_enter"]
    left = [e.time for e in events if e.kind == "zeno_release"]
    for enter in entered[:50]:
        leave = min([t for t in left if t > enter], default=results.time[-1])
        axis.axvspan(enter, leave, **HOLD)


def save(figure, path):
    """As SVG with two digits of a pixel, which is more than is seen; numbers that are read stay."""
    text = io.StringIO()
    figure.savefig(text, format="svg", metadata={"Date": None, "Creator": None}, dpi=110)
    plt.close(figure)
    path.write_text(TAG.sub(lambda tag: DIGITS.sub(r"\1", tag[0]), text.getvalue()))
