"""Random functions as Python source, over x (three states), t and k (a parameter).

Every function they are made of is analytic near real arguments, so that complex steps give
derivatives to the last digits; each argument is kept where the function is defined and grows
little.
"""

import random

LEAVES = ["x[0]", "x[1]", "x[2]", "x[-1]", "t", "k", "0.75", "2", "1.5", "C[0]", "math.pi"]
BINARY = [
    "({a} + {b})",
    "({a} - {b})",
    "({a} * {b})",
    "({a} / (2.0 + {b}**2))",
    "np.add({a}, {b})",
    "np.multiply({a}, {b})",
    "np.dot(np.array([{a}, 1.0]), np.array([2.0, {b}]))",
    "np.sum([{a}, {b}, {a}])",
    "(C @ np.array([{a}, {b}]))",
    "np.where(t < 5.0, {a}, {b})",
    "sum([{a} for _ in range(2)] + [{b}])",
    "np.cumsum([{a}, {b}])[1]",
    "np.prod([{a}, {b}])",
    "np.roll(np.array([{a}, {b}]), 1)[0]",
    "helper({a}, {b})",
]
UNARY = [
    "(-{a})",
    "{a}**2",
    "({a})**3",
    "np.sin({a})",
    "np.cos({a})",
    "np.tanh({a})",
    "np.arctan({a})",
    "np.exp(np.sin({a}))",
    "np.sinh(np.tanh({a}))",
    "np.cosh(np.sin({a}))",
    "np.expm1(np.tanh({a}))",
    "np.log(2.0 + ({a})**2)",
    "np.log1p(({a})**2)",
    "np.sqrt(1.0 + ({a})**2)",
    "(1.5 + np.cos({a}))**1.7",
    "(1.5 + np.sin({a}))**(0.5 * np.tanh({a}))",
    "np.arcsinh({a})",
    "np.arcsin(0.5 * np.tanh({a}))",
    "np.square({a})",
    "np.reciprocal(1.5 + np.sin({a}))",
]


def scalar(rng, depth):
    if depth == 0:
        return rng.choice(LEAVES)
    if rng.random() < 0.45:
        return rng.choice(UNARY).format(a=scalar(rng, depth - 1))
    a, b = scalar(rng, depth - 1), scalar(rng, rng.randrange(depth))
    return rng.choice(BINARY).format(a=a, b=b)


def vector(rng):
    """Source of an expression of two or three numbers."""
    forms = [
        lambda: f"np.array([{scalar(rng, 3)}, {scalar(rng, 2)}])",
        lambda: f"[{scalar(rng, 4)}, {scalar(rng, 1)}, {scalar(rng, 2)}]",
        lambda: f"{scalar(rng, 2)} * x + np.sin(x[::-1])",
        lambda: f"M @ (x * {scalar(rng, 2)})",
        lambda: f"np.concatenate([x[1:], np.array([{scalar(rng, 3)}])])",
        lambda: f"np.outer(x, x).sum(axis=0) * {scalar(rng, 2)}",
    ]
    return rng.choice(forms)()


def source(seed):
    """A function f(t, state, k) of several lines."""
    rng = random.Random(seed)
    lines = [
        "def f(t, state, k):",
        "    x = state.continuous_state",
        f"    a = {scalar(rng, 2)}",
        "    for i in range(2):",
        f"        a = a * x[i] + {scalar(rng, 1)}",
        f"    b = {vector(rng)}",
        "    return np.sin(a) + np.asarray(b)",
    ]
    return "\n".join(lines) + "\n"
