"""Saltus: the ready scenes, compiled into the library, as the peers that compile do it. Times are
those of `Simulator` runs, taken in C++; nothing but events is recorded.
"""

import json
import sys

from common import RTOLS
from scenes import SCENES

import saltus

METHODS = {False: ("dopri5", "dop853", "taylor", "auto"), True: ("radau", "bdf", "auto")}


def rows(name, scene):
    shelf = saltus.scene("kepler" if name == "kepler-alone" else name)
    methods = METHODS[scene.stiff]
    table = saltus.work_precision(shelf, methods=methods, rtols=RTOLS, least_time=0.2)
    for row in table:
        options = {"rtol": row["rtol"], "atol": row["atol"], "ode_solver_method": row["method"]}
        result = shelf.simulate(**options, save_at=[shelf.t_span[1]], save_steps=False, throw=False)
        yield {
            "peer": "Saltus", "method": row["method"], "scene": name, "rtol": row["rtol"],
            "cold": row["cold_seconds"], "seconds": row["seconds"],
            "events": [event.time for event in result.events],
            "end": next(iter(result.outputs.values()))[-1].ravel().tolist(),
        }  # fmt: skip


if __name__ == "__main__":
    for scene_name in SCENES:
        if scene_name != "kepler-alone":  # the shelf's has its monitor always
            for found in rows(scene_name, SCENES[scene_name]):
                print(json.dumps(found))
                sys.stdout.flush()
