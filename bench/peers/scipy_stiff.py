"""SciPy's implicit methods on the stiff scenes, with the exact Jacobian. `calls` are those of f."""

import sys

from scipy.integrate import solve_ivp
from stiff import rows
from stiff_scenes import SCENES


def run(scene, method, rtol):
    done = solve_ivp(
        scene.f, (0.0, scene.times[-1]), scene.start, method=method, t_eval=scene.times,
        jac=scene.jacobian, rtol=rtol, atol=rtol * scene.scale,
    )  # fmt: skip
    if done.status < 0:
        raise RuntimeError(done.message)
    counts = {"calls": done.nfev, "jacobians": done.njev, "factorisations": done.nlu}
    return counts, done.y.T.tolist()


if __name__ == "__main__":
    rows("SciPy", ("Radau", "BDF"), {name: SCENES[name] for name in sys.argv[1:] or SCENES}, run)
