"""The von Mises equations of motion, linearised by computer algebra about a radial flow.

Nothing here comes from the package under test. T and v are those of section 2; equations (2.8),
(2.9), (2.10), (2.13), (2.14) and the wall law (2.15), with rho g = 1, of

    sigma = r sigma0 (1 + e S), psi = psi0 + e Y, omega = e Z,
    v_r = -u0 (1 + e U) / r**2, v_theta = -e u0 W / r**2.
"""

from functools import lru_cache

import sympy as sp  # type: ignore[import-untyped]

t, theta, s, e, mu = sp.symbols("t theta s e mu", real=True)
r = sp.exp(t)
UNKNOWNS = ("S", "Y", "Z", "U", "W")
# Values and slopes of the base flow; values, rates and slopes of the five unknowns.
BASE = sp.symbols("sigma0 psi0 sigma0_slope psi0_slope", real=True)
JET = {name: sp.symbols(f"{name} {name}_t {name}_theta", real=True) for name in UNKNOWNS}


def stress(sigma, psi, omega):
    """T_rr, T_rt, T_tt and T_pp on the yield surface, which is a sphere in the deviator."""
    m = s / sp.sqrt(3)
    shape = sp.cos(omega) * sp.cos(2 * psi)
    return (
        sigma * (1 - 2 * m * shape),
        -sigma * s * sp.cos(omega) * sp.sin(2 * psi),
        sigma * (1 + m * shape + s * sp.sin(omega)),
        sigma * (1 + m * shape - s * sp.sin(omega)),
    )


def residuals(tensor, vr, vt):
    """Left minus right sides of (2.8), (2.9), (2.10), (2.13) times its denominators, (2.14)."""
    trr, trt, ttt, tpp = tensor
    d_r, cot = (lambda f: sp.diff(f, t) / r), sp.cot(theta)
    p = (trr + ttt + tpp) / 3
    dtt = (sp.diff(vt, theta) + vr) / r
    return {
        "2.8": d_r(trr) + (sp.diff(trt, theta) + 2 * trr + cot * trt - ttt - tpp) / r
        + sp.cos(theta),
        "2.9": d_r(trt) + (sp.diff(ttt, theta) + 3 * trt + cot * (ttt - tpp)) / r - sp.sin(theta),
        "2.10": d_r(vr) + (sp.diff(vt, theta) + 2 * vr + cot * vt) / r,
        "2.13": (vr + cot * vt) / r * (ttt - p) - dtt * (tpp - p),
        "2.14": dtt * 2 * trt - (ttt - p) * (d_r(vt) + sp.diff(vr, theta) / r - vt / r),
    }  # fmt: skip


@lru_cache(maxsize=1)
def linear_parts():
    """The derivatives by e of the residuals, in the symbols BASE and JET, at r = 1 and u0 = 1.

    Of the base flow only u0' = -sqrt(12) u0 tan(2 psi0) is used.
    """
    sigma0, psi0, u0 = (sp.Function(f"f{i}")(theta) for i in range(3))
    disturbance = {name: sp.Function(name)(t, theta) for name in UNKNOWNS}
    S, Y, Z, U, W = disturbance.values()
    tensor = stress(r * sigma0 * (1 + e * S), psi0 + e * Y, e * Z)
    full = residuals(tensor, -u0 * (1 + e * U) / r**2, -e * u0 * W / r**2)
    # The wall law, at a wall theta = const.
    full["2.15"] = tensor[1] + mu * tensor[2]
    plain = []
    for name, f in disturbance.items():
        value, rate, slope = JET[name]
        plain += [(f.diff(t), rate), (f.diff(theta), slope), (f, value)]
    plain += [
        (u0.diff(theta), -sp.sqrt(12) * u0 * sp.tan(2 * psi0)),
        (u0, 1),
        (sigma0.diff(theta), BASE[2]),
        (psi0.diff(theta), BASE[3]),
        (sigma0, BASE[0]),
        (psi0, BASE[1]),
        (t, 0),
    ]
    return {name: f.diff(e).subs(e, 0).doit().subs(plain) for name, f in full.items()}
