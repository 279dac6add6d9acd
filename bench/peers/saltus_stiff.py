"""Saltus on the same Python functions as SciPy: called as they are, with the same Jacobian; and
traced, which is what happens by default, with a Jacobian from the trace.
"""

import sys

from stiff import rows
from stiff_scenes import SCENES

import saltus

TRACED = "radau traced"


def run(scene, method, rtol):
    more = {} if method == TRACED else {"python": "called", "jacobian": scene.jacobian}
    done = saltus.solve(
        scene.f, (0.0, scene.times[-1]), scene.start, method=method.split()[0],
        t_eval=scene.times, rtol=rtol, atol=rtol * scene.scale, **more,
    )  # fmt: skip
    s = done.statistics
    counts = {
        "calls": s.right_hand_side_calls, "jacobians": s.jacobian_calls,
        "factorisations": s.linear_setups,
    }  # fmt: skip
    return counts, done.y.T.tolist()


if __name__ == "__main__":
    rows(
        "Saltus",
        ("radau", "bdf", TRACED),
        {name: SCENES[name] for name in sys.argv[1:] or SCENES},
        run,
    )
