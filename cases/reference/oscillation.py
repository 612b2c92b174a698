#!/usr/bin/env python3
"""The table of benchmark/oscillation.csv, without its header: how a drop that was drawn out a little swings, from rest.

    oscillation.py [--laplace LA] [--wall B] [--end T] [--interval I]     # needs mpmath

To first order in f the drop is r = 1 + f(t) P_2(cos theta), R0 = 1, time in mu_out R0/sigma, and both liquids of equal density
and viscosity, La = rho sigma R0/mu^2. They rest at t = 0, when f is 1; a rigid sphere of radius B holds the outer one.
The Laplace transforms of the radial velocity u P_2 are sums of r and j_2(q r)/r inside, of r, r^-4, j_2(q r)/r and h_2(q r)/r
outside, q = i sqrt(s La). At r = 1 u, v and the shear stress are continuous and the normal stress jumps by 4 F, outside less
inside with the sign of (l - 1)(l + 2) f; at B u = v = 0. With s F - 1 = u that is a linear system for each s, and Talbot's
contour inverts it. Written apart from the tests of the program, which seek the roots of its determinant only.
"""
import argparse

import mpmath as mp

L = 2


def power(n, r):
    return [mp.mpf(r) ** n, n * mp.mpf(r) ** (n - 1), n * (n - 1) * mp.mpf(r) ** (n - 2)]


def viscous(kind, q, r):
    """f_2(q r)/r with two derivatives, f_2 the spherical Bessel function j or h of the first kind."""
    z = q * r
    if kind == "j":
        f0, f1 = mp.sin(z) / z, mp.sin(z) / z**2 - mp.cos(z) / z
    else:
        f0, f1 = -1j * mp.exp(1j * z) / z, -(z + 1j) * mp.exp(1j * z) / z**2
    value, below = 3 / z * f1 - f0, f1
    slope = below - (L + 1) / z * value
    bend = -2 / z * slope - (1 - L * (L + 1) / z**2) * value
    return [value / r, q * slope / r - value / r**2, q * q * bend / r - 2 * q * slope / r**2 + 2 * value / r**3]


def terms(u, p, r):
    """u, v of v dP_2/dtheta, shear and normal stress of one function at r; mu = 1."""
    ll = L * (L + 1)
    v = (2 * u[0] + r * u[1]) / ll
    slope = (3 * u[1] + r * u[2]) / ll
    return u[0], v, slope - v / r + u[0] / r, -p + 2 * u[1]


def transform(s, laplace, wall):
    """F(s)."""
    q = 1j * mp.sqrt(s * laplace)  # so that h falls outwards

    def inner(r):
        return [terms(power(L - 1, r), -s * laplace * mp.mpf(r)**L / L, r), terms(viscous("j", q, r), 0, r)]

    def outer(r):
        return [terms(power(L - 1, r), -s * laplace * mp.mpf(r)**L / L, r),
                terms(power(-L - 2, r), s * laplace * mp.mpf(r)**(-L - 1) / (L + 1), r),
                terms(viscous("j", q, r), 0, r), terms(viscous("h", q, r), 0, r)]

    inside, outside, at_wall = inner(mp.mpf(1)), outer(mp.mpf(1)), outer(mp.mpf(wall))
    matrix, right = mp.zeros(7), mp.zeros(7, 1)
    for k, column in enumerate(inside):
        for i in range(4):
            matrix[i, k] = -column[i]
        matrix[6, k] = -column[0]                   # s F - u = 1
    for k, column in enumerate(outside):
        for i in range(4):
            matrix[i, 2 + k] = column[i]
        for i in range(2):
            matrix[4 + i, 2 + k] = at_wall[k][i]
    matrix[3, 6] = -(L - 1) * (L + 2)               # [normal stress], outer minus inner, = kappa's first order, (l - 1)(l + 2) F
    matrix[6, 6] = s
    right[6] = 1
    scale = [max(abs(matrix[i, k]) for i in range(7)) for k in range(7)]
    for k in range(7):
        for i in range(7):
            matrix[i, k] /= scale[k]
    return mp.lu_solve(matrix, right)[6] / scale[6]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--laplace", type=float, default=100.0)
    parser.add_argument("--wall", type=float, default=5.0)
    parser.add_argument("--end", type=float, default=40.0)
    parser.add_argument("--interval", type=float, default=0.5)
    parser.add_argument("--degree", type=int, default=100, help="terms of Talbot's rule")
    given = parser.parse_args()
    mp.mp.dps = max(40, int(1.2 * given.degree))
    print("t,f")
    print("0,1.0000000")
    for k in range(1, round(given.end / given.interval) + 1):
        t = k * given.interval
        f = mp.invertlaplace(lambda s: transform(s, mp.mpf(given.laplace), mp.mpf(given.wall)), t, method="talbot", degree=given.degree)
        print(f"{t:g},{mp.nstr(f, 8)}", flush=True)


if __name__ == "__main__":
    main()
