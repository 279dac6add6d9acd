"""The true event times and end states of the scenes: closed forms, or published numbers."""

import math

from scenes import SCENES


def ball():
    t, v, times = math.sqrt(2 * 10.0 / 9.81), math.sqrt(2 * 9.81 * 10.0), []
    while t <= SCENES["bouncing-ball"].end:
        times.append(t)
        v *= 0.9
        t += 2 * v / 9.81
    u = SCENES["bouncing-ball"].end - times[-1]
    return times, [u * (v - 9.81 * u / 2), v - 9.81 * u]


def on_table():
    """Parabolas; a landing is looked for in strides of 1 ms, then by bisection."""
    begin, y, v, end, times = 0.0, 1.0, 0.0, SCENES["ball-table"].end, []
    while True:
        gap = lambda t: y + (t - begin) * (v - 5.0 * (t - begin)) - 0.05 * math.sin(10 * t)  # noqa: B023, E731
        low = begin + 1e-3
        while low < end and gap(low + 1e-3) > 0:
            low += 1e-3
        if low >= end:
            u = end - begin
            return times, [y + u * (v - 5.0 * u), v - 10.0 * u]
        high = low + 1e-3
        for _ in range(60):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if gap(middle) > 0 else (low, middle)
        fall, table = v - 10.0 * (high - begin), 0.5 * math.cos(10 * high)
        times.append(high)
        begin, y, v = high, 0.05 * math.sin(10 * high), table - 0.8 * (fall - table)


def thermostat():
    t, temperature, on, times = 0.0, 19.0, True, []
    while True:
        goal, level = (40.0, 21.0) if on else (10.0, 19.0)
        after = t + 1800.0 * math.log((goal - temperature) / (goal - level))
        if after > SCENES["thermostat"].end:
            left = SCENES["thermostat"].end - t
            return times, [goal + (temperature - goal) * math.exp(-left / 1800.0)]
        t, temperature, on = after, level, not on
        times.append(t)


def kepler():
    """Kepler's equation E - e sin E = t by Newton's method; an apsis each half turn."""
    end, e = SCENES["kepler"].end, 0.6
    E = t = math.remainder(end, 2 * math.pi)
    for _ in range(50):
        E -= (E - e * math.sin(E) - t) / (1 - e * math.cos(E))
    b, rate = math.sqrt(1 - e * e), 1 / (1 - e * math.cos(E))
    state = [math.cos(E) - e, b * math.sin(E), -rate * math.sin(E), rate * b * math.cos(E)]
    return [k * math.pi for k in range(1, int(end / math.pi) + 1)], state


def answers():
    """{scene: (times, state)}. Robertson: Radau IIA of order 13 in 40 digits, which agrees with the
    Test Set for IVP Solvers; Van der Pol: that test set, and its crossings by DOPRI5 in 34 digits.
    """
    return {
        "bouncing-ball": ball(),
        "ball-table": on_table(),
        "thermostat": thermostat(),
        "kepler": kepler(),
        "kepler-alone": ([], kepler()[1]),
        "robertson": (
            [0.26401907818763256, 20795496.883026623],
            [5.2083451767992392e-8, 2.0833381779254890e-13, 0.99999994791633990],
        ),
        "van-der-pol": (
            [807.08474081587787, 1614.2853037200449],
            [1.706167732170465, -8.928097010248166e-4],
        ),
    }
