"""Where the stored numbers of tests/laws come from: closed forms of each piece, joined at roots
found to 30 digits. Run with mpmath 1.3; prints what the tests hold. No numerical integration of
the flights, wheels and circuits themselves, except the quadrature of the wheel's step time."""

from mpmath import asin, cos, diff, expm, eye, findroot, matrix, mp, mpf, pi, quad, sin, sqrt

mp.dps = 40


def first_root(f, start, step, skip=mpf("1e-12")):
    """The first sign change of f after start + skip, refined by bisection."""
    a = start + skip
    fa = f(a)
    while True:
        b = a + step
        fb = f(b)
        if (fa > 0) != (fb > 0):
            return findroot(f, (a, b), solver="anderson", tol=mpf("1e-60"))
        a, fa = b, fb


def sine_table(y0=mpf(1), v0=mpf(0), g=10, e=mpf("0.8"), amp=mpf("0.05"), w=10, n=12):
    """Impacts of a ball on the table amp sin(w t): v+ = vt - e (v - vt)."""
    t, y, v, out = mpf(0), y0, v0, []
    for _ in range(n):
        gap = lambda s: y + v * (s - t) - mpf(g) / 2 * (s - t) ** 2 - amp * sin(w * s)
        s = first_root(gap, t, mpf("1e-3"))
        before = v - g * (s - t)
        vt = amp * w * cos(w * s)
        t, y, v = s, amp * sin(w * s), vt - e * (before - vt)
        out.append((t, v))
    return out


def table_growth():
    """How much the time and the speed of each impact move with the start."""
    h = mpf("1e-15")
    base, up, fast = sine_table(), sine_table(y0=1 + h), sine_table(v0=h)
    rows = []
    for b, u, f in zip(base, up, fast):
        rows.append([max(abs(u[i] - b[i]), abs(f[i] - b[i])) / h for i in (0, 1)])
    return rows


def table_lifts(g=10, amp=mpf("0.15"), w=10):
    """A ball of restitution 0 on a table that falls away faster than gravity: lift-off, landing."""
    lift = asin(mpf(g) / (amp * w**2)) / w
    y, v = amp * sin(w * lift), amp * w * cos(w * lift)
    gap = lambda s: y + v * (s - lift) - mpf(g) / 2 * (s - lift) ** 2 - amp * sin(w * s)
    land = first_root(gap, lift, mpf("1e-3"), mpf("2e-2"))
    return lift, land, amp * sin(w * land), -amp * w**2 * sin(w * land)


def buck(vin=12, ind=mpf("1e-3"), cap=mpf("1e-4"), res=10, period=mpf("1e-4"), duty=mpf(2) / 5):
    """i' = (s vin - v) / L, v' = (i - v / R) / C, s = 1 in the first `duty` of each period."""
    a = matrix([[0, -1 / ind], [1 / cap, -1 / (res * cap)]])
    b = matrix([vin / ind, 0])
    on, off = expm(a * duty * period), expm(a * (1 - duty) * period)
    push = a**-1 * (on - eye(2)) * b
    x, out = matrix([0, 0]), {}
    for k in range(1, 501):
        x = off * (on * x + push)
        if k in (1, 10, 100, 500):
            out[k] = (x[0], x[1])
    return out


def rimless_wheel(alpha=mpf(pi) / 8, slope=mpf("0.08"), speed=mpf("0.4"), n=10):
    """theta'' = sin theta from slope - alpha to slope + alpha, then theta' *= cos 2 alpha."""
    t, out = mpf(0), []
    for _ in range(n):
        a, b, w = slope - alpha, slope + alpha, speed
        t += quad(lambda x: 1 / sqrt(w**2 + 2 * (cos(a) - cos(x))), [a, 0, b])
        speed = sqrt(w**2 + 2 * (cos(a) - cos(b))) * cos(2 * alpha)
        out.append((t, speed))
    return out


def show(name, rows):
    print(name)
    for row in rows:
        print("   ", ", ".join(mp.nstr(x, 17) for x in row))


if __name__ == "__main__":
    show("sine table: t, v after", sine_table())
    show("its growth", table_growth())
    show("table that falls away: lift, landing, height, acceleration there", [table_lifts()])
    show("buck converter: k, i, v", [(mpf(k), *x) for k, x in buck().items()])
    show("rimless wheel: t, speed after", rimless_wheel())
