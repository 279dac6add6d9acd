"""The linear circuits of the shelf in 60 digits: exponentials of their matrices and events by root
finding. Run with mpmath 1.3; prints the last event but one and the state behind it, as
shelf_hybrid_test.cpp holds them. Takes seconds."""

from mpmath import diag, eig, exp, findroot, lu_solve, matrix, mp, mpf, nstr, re

mp.dps = 60
TIGHT = mpf(10) ** -90


def flow(a, b):
    """x(d, x0) of x' = a x + b."""
    rest = lu_solve(a, -b)
    rates, modes = eig(a)
    into = modes**-1
    return lambda d, x: (
        rest + (modes * diag([exp(r * d) for r in rates]) * into * (x - rest)).apply(re)
    )


def show(name, events):
    number = len(events) - 1
    time, state = events[-2]
    print(name, number, nstr(time, 20), [nstr(value, 20) for value in state])


def relay_circuit():
    e, l, r1, c1 = mpf(10), mpf("1e-4"), mpf(100), mpf("1e-8")
    r2, c2, r3 = mpf("1e5"), mpf("1e-5"), mpf("2e5")
    a = matrix(
        [[-r1 / l, -1 / l, 0], [1 / c1, -1 / (r2 * c1), 1 / (r2 * c1)], [0, 1 / (r2 * c2), 0]]
    )
    a[2, 2] = -(1 / r2 + 1 / r3) / c2
    flows = [flow(a, matrix([0, 0, 0])), flow(a, matrix([e / l, 0, 0]))]
    t, x, on, events = mpf(0), matrix([0, 0, 0]), 1, []
    while t < 20:
        off = lambda d, x=x, on=on: flows[on](d, x)[2] - (4 if on else 2)
        d = findroot(off, (mpf("0.2"), mpf(1)), solver="anderson", tol=TIGHT)
        t, x, on = t + d, flows[on](d, x), 1 - on
        events.append((t, x))
    show("relay-circuit", [event for event in events if event[0] < 20])


def diode_turns(node, end):
    """The first change of sign of the node's voltage before `end`, in growing steps."""
    low = mpf(10) ** -16
    while low < end:
        high = min(low * mpf("1.3"), end)
        if (node(low) > 0) != (node(high) > 0):
            return findroot(node, (low, high), solver="anderson", tol=TIGHT)
        low = high
    return None


def buck_parasitics():
    e, l, c, r, on, off = (mpf(v) for v in ("20", "100e-6", "10e-6", "10", "0.1", "1e6"))
    cx, lc, series, period, end = (mpf(v) for v in ("10e-9", "20e-9", "0.02", "10e-6", "102.5e-6"))
    flows = []
    for mode in range(4):
        gs, gd = 1 / (on if mode % 2 else off), 1 / (on if mode >= 2 else off)
        a = matrix(4)
        a[0, 0], a[0, 2], a[0, 3], a[1, 3] = -r / l, 1 / l, r / l, 1 / c
        a[2, 0], a[2, 2] = -1 / cx, -(gs + gd) / cx
        a[3, 0], a[3, 1], a[3, 3] = r / lc, -1 / lc, -(r + series) / lc
        flows.append(flow(a, matrix([0, 0, e * gs / cx, 0])))
    t, x, mode, events, half = mpf(0), matrix([mpf("0.75"), 10, 0, 0]), 1, [], 1
    while True:
        tick = half * period / 2
        while True:
            node = lambda d, x=x, mode=mode: flows[mode](d, x)[2]
            d = diode_turns(node, min(tick, end) - t)
            if d is None:
                break
            t, x, mode = t + d, flows[mode](d, x), mode ^ 2
            events.append((t, x))
        if tick > end:
            break
        x, t = flows[mode](tick - t, x), tick
        mode = mode & 2 if half % 2 else mode | 1
        events.append((t, x))
        half += 1
    show("buck-parasitics", events)


if __name__ == "__main__":
    relay_circuit()
    buck_parasitics()
