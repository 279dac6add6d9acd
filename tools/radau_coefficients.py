"""Computes the coefficients of the Radau IIA methods.

Usage, with mpmath:

    python tools/radau_coefficients.py > include/saltus/solver/detail/radau/tables.hpp

Radau IIA with s stages is collocation at the zeros c_i of d^(s-1)/dx^(s-1) [x^(s-1) (x - 1)^s]
(E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, 2nd ed., IV.5, (5.7)).
Everything is computed with 60 digits and rounded once:

- A from sum_j a_ij c_j^(k-1) = c_i^k / k, k = 1..s (C(s), IV.5, p. 71)
- T, T^-1 with T^-1 A^-1 T block diagonal: gamma, then blocks [alpha -beta; beta alpha] (IV.8,
  (8.5))
- the error estimate: the quadrature formula of order s with the weight 1/gamma at the node 0, less
  the method's own, in terms of the stage values z = h A f (IV.8, (8.17) to (8.19); the RADAU code
  does the same for 5 and 7 stages)
- dense_share: for x' = t^s, the largest error of the collocation polynomial inside the step over
  the error estimate
"""

import mpmath as mp

mp.mp.dps = 60


def nodes(s):
    """c_1 < ... < c_s = 1."""
    radau = [mp.mpf(1)]
    for _ in range(s):  # (x - 1)^s
        radau = [a - b for a, b in zip([*radau, mp.mpf(0)], [mp.mpf(0), *radau], strict=True)]
    radau += [mp.mpf(0)] * (s - 1)  # times x^(s - 1)
    for _ in range(s - 1):
        degree = len(radau) - 1
        radau = [a * (degree - i) for i, a in enumerate(radau[:-1])]
    roots = sorted(mp.re(r) for r in mp.polyroots(radau, maxsteps=500, extraprec=400))
    roots[-1] = mp.mpf(1)
    return roots


def matrix_of(c):
    """A, from C(s)."""
    s = len(c)
    powers = mp.matrix(s, s)
    integrals = mp.matrix(s, s)
    for i in range(s):
        for k in range(s):
            powers[i, k] = c[i] ** k
            integrals[i, k] = c[i] ** (k + 1) / (k + 1)
    return integrals * powers**-1


def blocks(inverse):
    """gamma, the pairs (alpha, beta) with beta > 0 by rising alpha, and T."""
    s = inverse.rows
    values, vectors = mp.eig(inverse)
    real = min(range(s), key=lambda k: abs(mp.im(values[k])))
    pairs = sorted(
        (k for k in range(s) if k != real and mp.im(values[k]) > 0), key=lambda k: mp.re(values[k])
    )
    columns = [[mp.re(vectors[i, real] / vectors[s - 1, real]) for i in range(s)]]
    for k in pairs:  # q = u - i v belongs to alpha + i beta
        q = [vectors[i, k] / vectors[s - 1, k] for i in range(s)]
        columns += [[mp.re(each) for each in q], [-mp.im(each) for each in q]]
    t = mp.matrix(s, s)
    for j, column in enumerate(columns):
        for i in range(s):
            t[i, j] = column[i]
    return mp.re(values[real]), [(mp.re(values[k]), mp.im(values[k])) for k in pairs], t


def error_weights(c, inverse, gamma):
    """e with err = (gamma / h - J)^-1 (f(t, x) + sum e_i z_i / h)."""
    s = len(c)
    powers = mp.matrix(s, s)
    for i in range(s):
        for q in range(s):
            powers[q, i] = c[i] ** q
    right = mp.matrix(s, 1)
    right[0] = -1
    return (
        mp.lu_solve(powers, right)
    ).T * inverse  # times 1 / gamma, which the factor gamma takes back


def largest_error(c):
    """max over 0 < u < 1 of the error of the collocation polynomial for x' = t^s."""

    def error(u):
        return mp.quad(lambda t: mp.fprod(t - each for each in c), [0, u])

    return max(abs(error(each)) for each in c[:-1])


def dense_share(c, e, gamma):
    s = len(c)
    a = matrix_of(c)
    f = [each**s for each in c]
    z = [mp.fsum(a[i, j] * f[j] for j in range(s)) for i in range(s)]
    return largest_error(c) / abs(mp.fsum(e[i] * z[i] for i in range(s)) / gamma)


def weights(c):
    """Barycentric weights of the nodes 0, c_1, ..., c_s."""
    all_nodes = [mp.mpf(0), *c]
    return [1 / mp.fprod(a - b for b in all_nodes if b is not a) for a in all_nodes]


def number(value):
    return mp.nstr(value, 20, min_fixed=0, max_fixed=0) if value else "0.0"


def row(values):
    return ", ".join(number(v) for v in values)


def square(name, m):
    rows = ",\n      ".join("{" + row(m[i, j] for j in range(m.cols)) + "}" for i in range(m.rows))
    return f"  static constexpr double {name}[stages][stages] = {{\n      {rows}}};"


def table(s):
    c = nodes(s)
    a = matrix_of(c)
    inverse = a**-1
    gamma, pairs, t = blocks(inverse)
    e = error_weights(c, inverse, gamma)
    return f"""/// {s} stages, order {2 * s - 1}.
template <>
struct RadauTable<{s}> {{
  static constexpr int stages = {s};
  static constexpr double c[] = {{{row(c)}}};
{square("a", a)}
  static constexpr double gamma = {number(gamma)};
  static constexpr double alpha[] = {{{row(p[0] for p in pairs)}}};
  static constexpr double beta[] = {{{row(p[1] for p in pairs)}}};
{square("t", t)}
{square("t_inverse", t**-1)}
  static constexpr double e[] = {{{row(e)}}};
  static constexpr double weights[] = {{{row(weights(c))}}};
  static constexpr double dense_share = {number(dense_share(c, e, gamma))};
}};
"""


print("""// Coefficients of Radau IIA. Made by tools/radau_coefficients.py, which has their sources.
#pragma once

namespace saltus {

// clang-format off

/// Of the method with S stages: nodes c, matrix a; the eigenvalues gamma and alpha +- i beta of its
/// inverse and the transformation t with t_inverse a^-1 t block diagonal; weights e of the error
/// estimate; barycentric weights of the nodes 0, c; dense_share: the largest error of the
/// collocation polynomial in a step, in error estimates.
template <int S>
struct RadauTable;
""")
for stages in (3, 5, 7):
    print(table(stages))
print("// clang-format on\n\n}  // namespace saltus")
