"""Times a large model in SBML: S species, 2 S reactions of first order between random pairs.

python bench/sbml/large.py [S] [--roadrunner]

Prints the processor time of loading it, of a first run of 10 units of time, and of a second one.
"""

from __future__ import annotations

import argparse
import random
import time
from collections.abc import Callable
from typing import Any

REACTION = (
    '<reaction id="r{j}" reversible="false"><listOfReactants><speciesReference species="s{a}" '
    'stoichiometry="1" constant="true"/></listOfReactants><listOfProducts><speciesReference '
    'species="s{b}" stoichiometry="1" constant="true"/></listOfProducts><kineticLaw>'
    '<math xmlns="http://www.w3.org/1998/Math/MathML"><apply><times/><ci>k{j}</ci><ci>s{a}</ci>'
    "<ci>c</ci></apply></math></kineticLaw></reaction>"
)
SPECIES = (
    '<species id="s{i}" compartment="c" initialAmount="{value}" hasOnlySubstanceUnits="false" '
    'boundaryCondition="false" constant="false"/>'
)


def text_of(count: int, draw: random.Random) -> str:
    """The model with `count` species."""
    species = "".join(SPECIES.format(i=i, value=draw.random()) for i in range(count))
    constants = "".join(
        f'<parameter id="k{j}" value="{draw.random()}" constant="true"/>' for j in range(2 * count)
    )
    pairs = [draw.sample(range(count), 2) for _ in range(2 * count)]
    reactions = "".join(REACTION.format(j=j, a=a, b=b) for j, (a, b) in enumerate(pairs))
    return (
        '<sbml xmlns="http://www.sbml.org/sbml/level3/version2/core" level="3" version="2">'
        '<model id="large"><listOfCompartments><compartment id="c" spatialDimensions="3" size="1" '
        f'constant="true"/></listOfCompartments><listOfSpecies>{species}</listOfSpecies>'
        f"<listOfParameters>{constants}</listOfParameters>"
        f"<listOfReactions>{reactions}</listOfReactions></model></sbml>"
    )


def timed(name: str, act: Callable[[], Any]) -> Any:
    begin = time.process_time()
    result = act()
    print(f"{name:28} {time.process_time() - begin:10.4f} s")
    return result


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("species", nargs="?", type=int, default=1000)
    parser.add_argument("--roadrunner", action="store_true", help="libRoadRunner beside")
    chosen = parser.parse_args()
    text = text_of(chosen.species, random.Random(1))

    import saltus
    import saltus.sbml

    how: dict[str, Any] = {"rtol": 1e-6, "atol": 1e-10, "save_at": [0.0, 5.0, 10.0]}
    model = timed("load", lambda: saltus.sbml.load(text))
    for name in ("first run", "second run"):
        timed(name, lambda: saltus.simulate(model, (0.0, 10.0), **how))
    if not chosen.roadrunner:
        return
    import roadrunner

    other = timed("libRoadRunner: load", lambda: roadrunner.RoadRunner(text))
    other.integrator.relative_tolerance, other.integrator.absolute_tolerance = 1e-6, 1e-10
    for name in ("first run", "second run"):
        timed(f"libRoadRunner: {name}", lambda: other.simulate(0, 10, 3))
        other.reset()


if __name__ == "__main__":
    main()
