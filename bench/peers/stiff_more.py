"""More stiff scenes in NumPy, see stiff_scenes.py: E5, POLLU and the ring modulator."""

import numpy as np


def e5(t, y):
    decay, on = 7.89e-10 * y[0], 1.1e7 * y[0] * y[2]
    d2, d4 = decay - 1.13e9 * y[1] * y[2], on - 1.13e3 * y[3]
    return np.array([-decay - on, d2, d2 - d4, d4])


# Of each reaction of POLLU: the rate, one or two substances that react (0: none), the products.
REACTIONS = [
    (0.35, 1, 0, 2, 3), (26.6, 2, 4, 1), (1.23e4, 5, 2, 1, 6), (8.6e-4, 7, 0, 5, 5, 8),
    (8.2e-4, 7, 0, 8), (1.5e4, 7, 6, 5, 8), (1.3e-4, 9, 0, 10, 5, 8), (2.4e4, 9, 6, 11),
    (1.65e4, 11, 2, 1, 10, 12), (9e3, 11, 1, 13), (0.022, 13, 0, 11, 1), (1.2e4, 10, 2, 14, 1),
    (1.88, 14, 0, 7, 5), (1.63e4, 1, 6, 15), (4.8e6, 3, 0, 4), (3.5e-4, 4, 0, 16),
    (0.0175, 4, 0, 3), (1e8, 16, 0, 6, 6), (4.44e11, 16, 0, 3), (1240.0, 17, 6, 18, 5),
    (2.1, 19, 0, 2), (5.78, 19, 0, 1, 3), (0.0474, 1, 4, 19), (1780.0, 19, 1, 20),
    (3.12, 20, 0, 19, 1),
]  # fmt: skip
RATE = np.array([reaction[0] for reaction in REACTIONS])
FIRST = np.array([reaction[1] - 1 for reaction in REACTIONS])
SECOND = np.array([reaction[2] for reaction in REACTIONS])  # of 1, y1, y2, ...
CHANGE = np.zeros((20, 25))
for column, (_, a, b, *products) in enumerate(REACTIONS):
    for made, substances in ((-1.0, [a, b]), (1.0, products)):
        for substance in filter(None, substances):
            CHANGE[substance - 1, column] += made


def pollu(t, y):
    rate = RATE.reshape(-1, *[1] * (y.ndim - 1))
    second = np.concatenate([np.ones((1, *y.shape[1:])), y])[SECOND]
    return CHANGE @ (rate * y[FIRST] * second)


def pollu_start():
    start = np.zeros(20)
    start[[1, 3, 6, 7, 8, 16]] = 0.2, 0.04, 0.1, 0.3, 0.01, 0.007
    return start


def ring(t, y):
    C, Cs, Cp, Lh, Ls1, Ls2 = 1.6e-8, 2e-12, 1e-8, 4.45, 2e-3, 5e-4
    R, Rp, Rg1, Rg2, Ri, Rc = 25e3, 50.0, 36.3, 17.3, 50.0, 600.0
    in1, in2 = 0.5 * np.sin(2e3 * np.pi * t), 2.0 * np.sin(2e4 * np.pi * t)
    u = [y[2] - y[4] - y[6] - in2, -y[3] + y[5] - y[6] - in2,
         y[3] + y[4] + y[6] + in2, -y[2] - y[5] + y[6] + in2]  # fmt: skip
    q = [40.67286402e-9 * np.expm1(17.7493332 * voltage) for voltage in u]
    return np.array([
        (y[7] - 0.5 * y[9] + 0.5 * y[10] + y[13] - y[0] / R) / C,
        (y[8] - 0.5 * y[11] + 0.5 * y[12] + y[14] - y[1] / R) / C,
        (y[9] - q[0] + q[3]) / Cs, (-y[10] + q[1] - q[2]) / Cs,
        (y[11] + q[0] - q[2]) / Cs, (-y[12] - q[1] + q[3]) / Cs,
        (-y[6] / Rp + q[0] + q[1] - q[2] - q[3]) / Cp, -y[0] / Lh, -y[1] / Lh,
        (0.5 * y[0] - y[2] - Rg2 * y[9]) / Ls2, (-0.5 * y[0] + y[3] - Rg2 * y[10]) / Ls2,
        (0.5 * y[1] - y[4] - Rg2 * y[11]) / Ls2, (-0.5 * y[1] + y[5] - Rg2 * y[12]) / Ls2,
        (-y[0] + in1 - (Ri + Rg1) * y[13]) / Ls1, (-y[1] - (Rc + Rg1) * y[14]) / Ls1,
    ])  # fmt: skip
