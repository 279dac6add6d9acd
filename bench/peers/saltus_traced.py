"""Saltus on the same plain Python equations as the peers: traced callbacks, as machine code where
llvmlite is installed, and a simulator that is used again.
"""

from common import main
from flights_saltus import runner
from saltus_shelf import METHODS
from scenes import SCENES


def suitable(method):
    """The runner of a method, for the scenes for which the shelf has it too."""
    make = runner(method)
    return lambda scene, rtol: make(scene, rtol) if method in METHODS[scene.stiff] else None


if __name__ == "__main__":
    names = dict.fromkeys(METHODS[False] + METHODS[True])
    main("Saltus, Python", {name: suitable(name) for name in names}, SCENES)
