"""`solve_ivp` of SciPy's own tests, answered by `saltus.solve`.

It changes method names (those of solver classes too), the status from a word to SciPy's number, and
the default method and tolerances. Everything else reaches `solve` as the test wrote it.
"""

import saltus

STATUS = {"reached_end": 0, "terminal": 1}


class Answer:
    """A solution whose status is a number."""

    def __init__(self, solution):
        self._solution = solution
        self.status = STATUS.get(solution.status, -1)

    def __getattr__(self, name):
        return getattr(self._solution, name)


def solve_ivp(fun, t_span, y0, method="RK45", rtol=1e-3, atol=1e-6, **options):
    """`scipy.integrate.solve_ivp` by `saltus.solve`."""
    options["jacobian"] = options.pop("jac", None)
    options["jacobian_sparsity"] = options.pop("jac_sparsity", None)
    name = getattr(method, "__name__", method)
    return Answer(
        saltus.solve(fun, t_span, y0, method=name, rtol=rtol, atol=atol, throw=False, **options)
    )
