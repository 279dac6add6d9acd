"""Smooth flights with and without events, in plain Python as in `scenes.py`: for `taylor.py`."""

from itertools import combinations

from scenes import SCENES, Guard, Scene


def pendulum(m, t, x, mode):
    return [x[1], -9.8 * m.sin(x[0])]


def galaxy(m, t, x, mode):
    """The potential of M. Henon and C. Heiles, Astron. J. 69 (1964) 73. State: velocities, places."""
    vx, vy, px, py = x
    return [-px - 2.0 * px * py, py * py - py - px * px, vx, vy]


def heater(m, t, x, mode):
    return [(10.0 + 30.0 * mode - x[0]) / 1800.0, (x[0] - x[1]) / 60.0]


def bodies(masses, gravity=1.0, dimensions=2):
    """Newton's law for bodies with these masses. State: all places, then all velocities."""
    n, d = len(masses), dimensions

    def flow(m, t, x, mode):
        pull = [0.0] * (n * d)
        for i, j in combinations(range(n), 2):
            apart = [x[j * d + k] - x[i * d + k] for k in range(d)]
            r2 = sum(a * a for a in apart)
            w = gravity / (r2 * m.sqrt(r2))
            for k in range(d):
                pull[i * d + k] = pull[i * d + k] + masses[j] * w * apart[k]
                pull[j * d + k] = pull[j * d + k] - masses[i] * w * apart[k]
        return [*x[n * d :], *pull]

    return flow


# Places and velocities of the Sun and the outer planets [AU, AU/day], masses in Suns: E. Hairer,
# C. Lubich, G. Wanner, Geometric Numerical Integration, 2nd ed., p. 13, with the Sun at rest.
PLANETS = [
    (1.00000597682, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)),
    (0.000954786104043, (-3.5023653, -3.8169847, -1.5507963), (0.00565429, -0.00412490, -0.00190589)),
    (0.000285583733151, (9.0755314, -3.0458353, -1.6483708), (0.00168318, 0.00483525, 0.00192462)),
    (0.0000437273164546, (8.3101420, -16.2901086, -7.2521278), (0.00354178, 0.00137102, 0.00055029)),
    (0.0000517759138449, (11.4707666, -25.7294829, -10.8169456), (0.00288930, 0.00114527, 0.00039677)),
    (1.0 / 1.3e8, (-15.5387357, -25.2225594, -3.1902382), (0.00276725, -0.00170702, -0.00136504)),
]  # fmt: skip

TURNS = [Guard(lambda m, t, x: x[1]), Guard(lambda m, t, x: x[1] * x[1] - 1e-12)]

FLIGHTS = {
    "kepler-alone": SCENES["kepler-alone"],
    "kepler": SCENES["kepler"],
    "pendulum": Scene(pendulum, [0.05, 0.0], 100.3, TURNS, atol=1.0),
    "henon-heiles": Scene(
        galaxy, [-0.2525875586263492, -0.2178423952983717, 0.0, 0.2587703282931232], 200.0,
        [Guard(lambda m, t, x: x[2], 1)], atol=1.0,
    ),
    "figure-eight": Scene(
        bodies([1.0, 1.0, 1.0]),
        [0.97000436, -0.24308753, -0.97000436, 0.24308753, 0.0, 0.0,
         0.466203685, 0.43236573, 0.466203685, 0.43236573, -0.93240737, -0.86473146],
        20.0, atol=1.0,
    ),
    "pythagorean": Scene(
        bodies([3.0, 4.0, 5.0]), [1.0, 3.0, -2.0, -1.0, 1.0, -1.0, *([0.0] * 6)], 10.0, atol=1.0
    ),
    "pleiades": Scene(
        bodies([1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]),
        [3.0, 3.0, 3.0, -3.0, -1.0, 2.0, -3.0, 0.0, 2.0, 0.0, -2.0, -4.0, 2.0, 4.0,
         0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -1.25, 0.0, 1.0, 1.75, 0.0, -1.5, 0.0],
        3.0, atol=1.0,
    ),
    "outer-planets": Scene(
        bodies([mass for mass, _, _ in PLANETS], gravity=2.95912208286e-4, dimensions=3),
        [*sum((place for _, place, _ in PLANETS), ()), *sum((v for _, _, v in PLANETS), ())],
        50000.0, atol=1e-2,
    ),
    "thermostat-lag": Scene(
        heater, [19.0, 19.0], 200000.0,
        [Guard(lambda m, t, x: x[1] - 21.0, 1, lambda m, t, x: ([x[0], x[1]], 0), mode=1),
         Guard(lambda m, t, x: x[1] - 19.0, -1, lambda m, t, x: ([x[0], x[1]], 1), mode=0)], mode=1,
    ),
    "thermostat": SCENES["thermostat"],
    "bouncing-ball": SCENES["bouncing-ball"],
    "ball-table": SCENES["ball-table"],
}  # fmt: skip
