"""heyoka on the flights, and the answers: its long double at a tolerance of 1e-18."""

import sys

import heyoka as hy
import heyoka_taylor
import numpy as np
from common import main
from flights import FLIGHTS


def exact(scene, _):
    return heyoka_taylor.make(scene, 1e-18, fp_type=np.longdouble)


if __name__ == "__main__":
    names = sys.argv[1:] or list(FLIGHTS)
    scenes = {name: FLIGHTS[name] for name in names}
    main("heyoka", {"Taylor": heyoka_taylor.make}, scenes)
    main("answer", {"long double": exact}, scenes, rtols=(1e-18,))
