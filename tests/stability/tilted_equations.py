"""The stress equations and their linearisation by computer algebra, before any division.

T = r T(t, theta), t = log r, turns the equations of motion (2.8), (2.9) into two equations in t and
theta alone. Linearised about a radial solution, with u = (sigma1, psi1),

    E1 u_t + E2 u_theta + E0 u = 0,     u_theta + N u_t + K u = 0,     N, K = E2^-1 (E1, E0).

Nothing here comes from the package. The symbols are module constants; ``k`` = d - 2 stays symbolic.
"""

from functools import lru_cache

import sympy as sp  # type: ignore[import-untyped]

T, THETA, EPS = sp.symbols("t theta epsilon")
S, K = sp.symbols("s k")
SIGMA, PSI, D_SIGMA, D_PSI = sp.symbols("sigma psi dsigma dpsi")


def motion(sigma, psi):
    """Return the radial and the angular equation of motion, over r, for fields of (t, theta)."""
    r = sp.exp(T)
    trr = r * sigma * (1 - S * sp.cos(2 * psi))
    ttt = r * sigma * (1 + S * sp.cos(2 * psi))
    trt = -r * sigma * S * sp.sin(2 * psi)
    tpp = r * sigma * (1 + S)

    def divergence(along, across, curved):
        # d/dr = exp(-t) d/dt.
        return (sp.diff(along, T) + sp.diff(across, THETA) + curved) / r

    cot = sp.cot(THETA)
    radial = divergence(trr, trt, (1 + K) * trr - ttt - K * tpp + K * cot * trt) + sp.cos(THETA)
    angular = divergence(trt, ttt, (2 + K) * trt + K * cot * (ttt - tpp)) - sp.sin(THETA)
    return radial, angular


@lru_cache(maxsize=1)
def radial_equations():
    """Return both equations for fields of theta alone, slopes as the symbols D_SIGMA, D_PSI."""
    sigma, psi = (sp.Function(name)(THETA) for name in ("a", "b"))
    plain = {sigma.diff(THETA): D_SIGMA, psi.diff(THETA): D_PSI}
    equations = [e.doit().subs(plain).subs({sigma: SIGMA, psi: PSI}) for e in motion(sigma, psi)]
    return [sp.expand(e) for e in equations]


@lru_cache(maxsize=1)
def base_slopes():
    """Return sigma' and psi' of a radial solution as the two equations prescribe them."""
    matrix, right = sp.linear_eq_to_matrix(radial_equations(), [D_SIGMA, D_PSI])
    return tuple(matrix.adjugate() * right / matrix.det())


@lru_cache(maxsize=1)
def linearised():
    """Return E1, E2 and E0; entries in S, K, THETA, SIGMA, PSI, D_SIGMA, D_PSI."""
    sigma0, psi0 = (sp.Function(name)(THETA) for name in ("sigma0", "psi0"))
    sigma1, psi1 = (sp.Function(name)(T, THETA) for name in ("sigma1", "psi1"))
    equations = motion(sigma0 + EPS * sigma1, psi0 + EPS * psi1)
    linear = sp.Matrix([e.diff(EPS).subs(EPS, 0).doit() for e in equations])
    groups = [[sigma1.diff(v), psi1.diff(v)] for v in (T, THETA)] + [[sigma1, psi1]]
    names = [sp.symbols(f"{letter}:2") for letter in "xyz"]
    # Derivatives first: they contain the functions.
    for group, name in zip(groups, names, strict=True):
        linear = linear.subs(dict(zip(group, name, strict=True)))
    base = {sigma0.diff(THETA): D_SIGMA, psi0.diff(THETA): D_PSI}
    linear = linear.subs(base).subs({sigma0: SIGMA, psi0: PSI})
    # The factor exp(-t) exp(t) cancels: the equations are autonomous in t.
    linear = sp.expand(linear)
    return tuple(linear.jacobian(name) for name in names)


@lru_cache(maxsize=1)
def solved_for_slopes():
    """Return N and K, with the slopes of the radial solution left as symbols."""
    e1, e2, e0 = linearised()
    inverse = e2.adjugate() / e2.det()
    return inverse * e1, inverse * e0


@lru_cache(maxsize=2)
def compiled(k):
    """Return f(s, theta, sigma, psi) -> (sigma', psi', N11 ... N22, K11 ... K22), plain floats."""
    n, kk = solved_for_slopes()
    d_sigma, d_psi = base_slopes()
    entries = [d_sigma, d_psi, *n, *(e.subs({D_SIGMA: d_sigma, D_PSI: d_psi}) for e in kk)]
    return sp.lambdify((S, THETA, SIGMA, PSI), [e.subs(K, k) for e in entries], "math", cse=True)
