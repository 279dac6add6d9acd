"""The hybrid scenes of the shelf by a way of their own: the equations themselves, integrated in 30
digits by the method of Gragg, Bulirsch and Stoer (order 24) instead of closed forms, and events at
the roots found on its steps. Run with mpmath 1.3; prints the last event and the state behind it, as
shelf_hybrid_test.cpp holds them. Takes a minute."""

import sys

from mpmath import findroot, mp, mpf, nstr, sin, sqrt

mp.dps = 30


def midpoint(ode, t, x, step, n):
    """Gragg's modified midpoint rule, n substeps: its error is a series in (step / n)^2."""
    h = step / n
    old, new = x, [a + h * d for a, d in zip(x, ode(t, x), strict=True)]
    for k in range(1, n):
        slope = ode(t + k * h, new)
        old, new = new, [a + 2 * h * d for a, d in zip(old, slope, strict=True)]
    slope = ode(t + step, new)
    return [(a + b + h * d) / 2 for a, b, d in zip(old, new, slope, strict=True)]


def advance(ode, t, x, step):
    """One step, extrapolated from 2, 4, ..., 24 substeps (Aitken, Neville)."""
    table = []
    for k in range(1, 13):
        row = [midpoint(ode, t, x, step, 2 * k)]
        for j, before in enumerate(table):
            weight = mpf(k) ** 2 / mpf(k - j - 1) ** 2 - 1
            row.append([a + (a - b) / weight for a, b in zip(row[j], before, strict=True)])
        table = row
    return table[-1]


def first(ode, guards, t, x, stride, end):
    """The first guard to change its sign behind t, the time and the state there; at the latest end."""
    x, t = advance(ode, t, x, min(stride, end - t)), min(t + stride, end)
    above = [g(t, x) > 0 for g in guards]
    while t < end:
        step = min(stride, end - t)
        y = advance(ode, t, x, step)
        crossed = [i for i, g in enumerate(guards) if (g(t + step, y) > 0) != above[i]]
        roots = []
        for i in crossed:
            at = lambda h, i=i: guards[i](t + h, advance(ode, t, x, h))
            roots.append((findroot(at, (0, step), solver="anderson", tol=mpf(10) ** -52), i))
        if roots:
            h, which = min(roots)
            return t + h, advance(ode, t, x, h), which
        t, x = t + step, y
    return t, x, None


def run(name, x, mode, ode, guards, jump, stride, events, ticks=None):
    """`events` events from x in a mode: ode(mode), guards(mode), jump(which, t, x, mode)."""
    t = mpf(0)
    for _ in range(events):
        end = ticks(t) if ticks else t + 10000 * stride
        t, x, which = first(ode(mode), guards(mode), t, x, stride, end)
        x, mode = jump(which, t, x, mode)
    print(name, events, nstr(t, 17), *(nstr(v, 17) for v in x), flush=True)


def ball_drag():
    g, c, e = mpf(9.81), mpf(0.05), mpf(0.8)
    rises = lambda t, x: [x[1], -g - c * x[1] ** 2]
    falls = lambda t, x: [x[1], -g + c * x[1] ** 2]
    jump = lambda i, t, x, mode: (
        ([mpf(0), -e * x[1]], "rises") if mode == "falls" else ([x[0], mpf(0)], "falls")
    )
    run(
        "ball-drag",
        [mpf(10), mpf(0)],
        "falls",
        lambda mode: falls if mode == "falls" else rises,
        lambda mode: [lambda t, x: x[0] if mode == "falls" else x[1]],
        jump,
        mpf(1) / 32,
        9,
    )


def integrate_and_fire():
    tau, a, b, w = mpf(0.02), 16, 6, mpf(2 * 3.141592653589793 * 8)
    run(
        "integrate-and-fire",
        [mpf(0)],
        0,
        lambda mode: lambda t, x: [(a + b * sin(w * t) - x[0]) / tau],
        lambda mode: [lambda t, x: x[0] - 15],
        lambda i, t, x, mode: ([mpf(0)], 0),
        mpf(1) / 1024,
        16,
    )


def stick_slip():
    belt, fs, fk = mpf(0.1), mpf(1), mpf(0.6)
    stick = lambda t, x: [x[1], mpf(0)]
    slip = lambda t, x: [x[1], fk - x[0]]
    run(
        "stick-slip",
        [mpf(0), belt],
        "stick",
        lambda mode: stick if mode == "stick" else slip,
        lambda mode: [(lambda t, x: x[0] - fs) if mode == "stick" else lambda t, x: x[1] - belt],
        lambda i, t, x, mode: ([x[0], belt], "slip" if mode == "stick" else "stick"),
        mpf(1) / 16,
        9,
    )


def rocking_block():
    p, alpha, r = mpf(2), mpf(0.2), mpf(0.9)
    run(
        "rocking-block",
        [mpf(0.15), mpf(0)],
        1,
        lambda mode: lambda t, x: [x[1], p**2 * (x[0] - mode * alpha)],
        lambda mode: [lambda t, x: x[0]],
        lambda i, t, x, mode: ([mpf(0), r * x[1]], -mode),
        mpf(1) / 64,
        8,
    )


def buck_converter():
    E, L, C, R, T = mpf(20), mpf(20e-3), mpf(47e-6), mpf(22), mpf(400e-6)
    a, v_ref, low, high = mpf(8.4), mpf(11.3), mpf(3.8), mpf(8.2)
    control = lambda v: a * (v - v_ref)
    tick = lambda t: int(t / T + mpf(1e-9)) * T
    meets = lambda t, x: control(x[1]) - low - (high - low) * (t - tick(t)) / T

    def jump(which, t, x, mode):
        if which is not None:
            return list(x), 1
        return list(x), 0 if control(x[1]) > low else 1

    run(
        "buck-converter",
        [mpf(0.6), mpf(12)],
        0,
        lambda mode: lambda t, x: [(mode * E - x[1]) / L, (x[0] - x[1] / R) / C],
        lambda mode: [meets] if mode == 0 else [],
        jump,
        T / 32,
        51,
        ticks=lambda t: tick(t) + T,
    )


def stiff_contact():
    g, k = mpf(9.81), mpf(10) ** 9
    d = sqrt(k)
    touches = lambda t, x: [x[1], -g - k * x[0] - d * x[1]]
    t, x = sqrt(mpf(2e-3) / g), [mpf(0), -sqrt(mpf(2e-3) * g)]
    for _ in range(2):  # a flight from the floor is 2 v / g long
        lasts, (_, v), _ = first(touches, [lambda s, y: y[0]], mpf(0), x, mpf(2e-6), mpf(1e-3))
        t, x = t + lasts + 2 * v / g, [mpf(0), -v]
    print("stiff-contact 5", nstr(t, 17), *(nstr(v, 17) for v in x), flush=True)


def newtons_cradle():
    n, gap, w = 5, mpf(1e-3), mpf(5)
    hangs = [i * gap for i in range(n)]
    x = [-mpf(0.1), *hangs[1:], *[mpf(0)] * n]

    def jump(i, t, x, mode):
        x = list(x)
        x[n + i], x[n + i + 1] = x[n + i + 1], x[n + i]
        return x, 0

    pair = lambda i: lambda t, x: x[i + 1] - x[i]
    run(
        "newtons-cradle",
        x,
        0,
        lambda mode: (
            lambda t, x: x[n:] + [w**2 * (h - p) for h, p in zip(hangs, x[:n], strict=True)]
        ),
        lambda mode: [pair(i) for i in range(n - 1)],
        jump,
        mpf(2e-4),
        8,
    )


if __name__ == "__main__":
    scenes = [ball_drag, integrate_and_fire, stick_slip, rocking_block, buck_converter]
    for scene in [*scenes, stiff_contact, newtons_cradle]:
        if len(sys.argv) < 2 or scene.__name__ in sys.argv[1:]:
            scene()
