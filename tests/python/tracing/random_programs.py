"""Random programs as Python source that mix truths, integers and reals, choices and assignments.

They see x (three states), u (an input of three), t, k (a parameter), n (the mode) and W, a global.
"""

import random

NUMBERS = "x[0] x[1] x[2] t k 0.5 2 -1.5 n 0 True u[0] u[1] W[n%3]".split()
ARRAYS = [
    "x", "u", "W", "x[::-1]", "(W * 2)", "np.array([t,k,1.0])", "np.zeros(3)", "np.arange(3)",
    "np.array([True,False,True])", "(x>0)", "x.astype(int)",
]  # fmt: skip
NUMBER_FORMS = """
    ({n} + {n})|({n} - {n})|({n} * {n})|({n} < {n})|({n} <= {n})|({n} == {n})|({n} != {n})
    np.where({n}, {n}, {n})|min({n}, {n})|max({n}, {n}, {n})|np.maximum({n}, {n})
    np.fmin({n}, {n})|np.hypot({n}, {n})|np.arctan2({n}, {n})|np.copysign({n}, {n})
    np.logical_and({n}, {n})|np.logical_xor({n}, {n})|({n} // 0.3)|({n} % -2)|({n} / 1.5)
    ({n} // 3)|abs({n})|float({n})|int({n})|round({n})|bool({n})|math.floor({n})|math.ceil({n})
    math.tanh({n})|np.sign({n})|np.floor({n})|np.float64({n})|{a}[0]|{a}[2]|np.sum({a})
    np.max({a})|np.mean({a})|np.any({a})|sum({a})|max({a})|np.count_nonzero({a})|({a} @ {a})
    ({n})**2|({n})**3|np.logical_not({n})|(-{n})
""".replace("\n", "|").split("|")
ARRAY_FORMS = """
    ({a} + {a})|({a} - {a})|({a} * {a})|({a} < {a})|({a} >= {a})|({a} == {a})
    np.where({a}, {a}, {a})|np.clip({a}, -1, {n})|np.array([{n},{n},{n}])|np.cumsum({a})
    np.roll({a}, 1)|({a} // 3)|({a} % -2)|np.select([{a} > 0, {a} < 1], [{a}, {a}], {n})
    np.concatenate([{a}[:1], {a}[1:]])|({a} * {n})|np.abs({a})|np.sign({a})|np.floor({a})
    np.logical_not({a})|np.tanh({a})|np.square({a})
""".replace("\n", "|").split("|")
RETURNS = ["b", "a", "b * a", "[a, b[0]]", "np.array([a, b[1]]) + 1", "a == b", "(a, b.sum())"]


def _filled(rng, forms, leaves, depth):
    if depth <= 0:
        return rng.choice(leaves)
    form = rng.choice([form.strip() for form in forms if form.strip()])
    while "{n}" in form:
        form = form.replace("{n}", _filled(rng, NUMBER_FORMS, NUMBERS, depth - 1), 1)
    while "{a}" in form:
        form = form.replace("{a}", _filled(rng, ARRAY_FORMS, ARRAYS, depth - 1), 1)
    return form


def source(seed):
    """A function f(t, state, u, k)."""
    rng = random.Random(seed)

    def number(depth):
        return _filled(rng, NUMBER_FORMS, NUMBERS, depth)

    def array(depth):
        return _filled(rng, ARRAY_FORMS, ARRAYS, depth)

    head = ["x, n = state.continuous_state, state.mode", f"a = {number(2)}"]
    bodies = [
        [f"b = {array(2)}"],
        [
            "b = np.zeros(3)",
            "b[0] = a",
            f"b[1:] = {array(1)}[1:]",
            f"b[b > {number(1)}] = {number(1)}",
        ],
        ["b = np.zeros(3, dtype=int)", f"b[:2] += {rng.choice(['n', '1'])}", f"b[2] = {number(1)}"],
    ]
    lines = [*head, *rng.choice(bodies), f"return {rng.choice(RETURNS)}"]
    return "def f(t, state, u, k):\n" + "".join(f"    {line}\n" for line in lines)
