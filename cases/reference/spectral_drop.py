#!/usr/bin/env python3
"""The transient of one drop in unbounded simple shear or uniaxial extension, lambda = 1, to six digits: reference data for the cases.

    spectral_drop.py CA [--flow extension] [--degree P] [--dt DT] [--end T] [--interval I]

Writes t,D,L,B,W,extent_x,D_inertia and the volume drift to standard output. Needs numpy; shares nothing with the program.

The interface is x(theta, phi, t) = s(theta, phi, t) M y with y on the unit sphere, s a sum of spherical harmonics up to
degree P, and M a fixed ellipsoid between the shapes at the start and at the end, so that s decays fast: at Ca = 0.38 the
last two degrees are below 5e-5, 3e-6 and 2e-7 of the first for P = 12, 16 and 20. It moves with the normal velocity,

    v(x0) = G x0 - 1/(8 pi Ca) oint (I/r + r r/r^3) . n kappa dS,     ds/dt = v.n / (n . M y),

which for lambda = 1 is all there is: no double layer. The integral is taken in polar coordinates about each target, whose
Jacobian cancels 1/r: Gauss-Legendre points in the polar angle and equal ones around it, where the fields come from their
harmonics. Every error falls exponentially with P, but for that of the Runge-Kutta steps, of fourth order.

Checked against exact values: relaxation rate of l = 2, 0.4571428 (80/175 = 0.4571429); D at Ca = 0.02, 1.00016 times
Taylor's 1.09375 Ca. Pinned to shapes that are star-shaped seen from M: no necks.
"""
import argparse

import numpy as np


def legendre(degree, theta):
    """Orthonormal associated Legendre functions P[l, m] at theta, by recurrence in l."""
    c, s = np.cos(theta), np.sin(theta)
    P = np.zeros((degree + 1, degree + 1, len(theta)))
    P[0, 0] = np.sqrt(1 / (4 * np.pi))
    for m in range(1, degree + 1):
        P[m, m] = -np.sqrt((2 * m + 1) / (2 * m)) * s * P[m - 1, m - 1]
    for m in range(degree):
        P[m + 1, m] = np.sqrt(2 * m + 3) * c * P[m, m]
        for l in range(m + 2, degree + 1):
            a = np.sqrt((4 * l * l - 1) / (l * l - m * m))
            b = np.sqrt(((l - 1) ** 2 - m * m) / (4 * (l - 1) ** 2 - 1))
            P[l, m] = a * (c * P[l - 1, m] - b * P[l - 2, m])
    return P


def orders(degree):
    """(l, m) of each coefficient; where m > 0 that of cos(m phi), then that of sin(m phi)."""
    return [(l, m) for l in range(degree + 1) for m in range(l + 1) for _ in range(1 if m == 0 else 2)]


def harmonics(degree, theta, phi):
    """Real orthonormal harmonics: a matrix (points, coefficients)."""
    P = legendre(degree, theta)
    columns = []
    for l in range(degree + 1):
        columns.append(P[l, 0])
        for m in range(1, l + 1):
            f = np.sqrt(2) * P[l, m]
            columns += [f * np.cos(m * phi), f * np.sin(m * phi)]
    return np.array(columns).T.copy()


def derivatives(degree, theta, phi):
    """The harmonics and their derivatives d_t, d_p, d_tt, d_tp, d_pp (t: theta, p: phi), away from the poles."""
    P = legendre(degree, theta)
    c, s = np.cos(theta), np.sin(theta)
    columns = [[] for _ in range(6)]
    for l in range(degree + 1):
        for m in range(l + 1):
            scale = np.sqrt(2) if m else 1.0
            f = scale * P[l, m]
            below = scale * P[l - 1, m] * np.sqrt((2 * l + 1) / (2 * l - 1) * (l * l - m * m)) if l > m else 0.0
            f_t = (l * c * f - below) / s
            f_tt = -c / s * f_t - (l * (l + 1) - m * m / s**2) * f
            waves = [(np.cos(m * phi), -m * np.sin(m * phi))]
            if m:
                waves.append((np.sin(m * phi), m * np.cos(m * phi)))
            for wave, slope in waves:
                for column, value in zip(columns, (f * wave, f_t * wave, f * slope, f_tt * wave, f_t * slope,
                                                   -m * m * f * wave)):
                    column.append(value)
    return [np.array(column).T.copy() for column in columns]


def directions(theta, phi):
    """y on the unit sphere and its derivatives, in the order of `derivatives`."""
    st, ct, sp, cp = np.sin(theta), np.cos(theta), np.sin(phi), np.cos(phi)
    zero = 0 * theta
    y = np.stack([st * cp, st * sp, ct], -1)
    return (y, np.stack([ct * cp, ct * sp, -st], -1), np.stack([-st * sp, st * cp, zero], -1), -y,
            np.stack([-ct * sp, ct * cp, zero], -1), np.stack([-st * cp, -st * sp, zero], -1))


def turn_about_z(angle):
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])


class Grid:
    """Gauss points in cos(theta), equal ones in phi: exact for products of harmonics up to the degree."""

    def __init__(self, degree, field_degree):
        x, w = np.polynomial.legendre.leggauss(degree + 1)
        self.rings, self.around = degree + 1, 2 * degree + 2
        theta, phi = np.meshgrid(np.arccos(-x), 2 * np.pi * np.arange(self.around) / self.around, indexing="ij")
        self.theta, self.phi = theta.ravel(), phi.ravel()
        self.weights = np.repeat(2 * np.pi * w / self.around, self.around)
        self.harmonics = derivatives(field_degree, self.theta, self.phi)
        self.directions = directions(self.theta, self.phi)

    def projection(self, degree):
        """Matrix from values to the coefficients of a degree."""
        return (harmonics(degree, self.theta, self.phi) * self.weights[:, None]).T


# Velocity gradient, half-axes of M and their angle to the x-axis. Both flows are their own mirror image in z and stay as they are when
# turned by pi about it, of which `single_layer` makes use.
FLOWS = {
    "shear": (np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]]), (1.36, 0.81, 0.90), np.pi / 6),
    "extension": (np.diag([1.0, -0.5, -0.5]), (1.07, 0.967, 0.967), 0.0),
}


class Drop:
    def __init__(self, Ca, degree, flow="shear"):
        self.Ca, self.degree = Ca, degree
        self.G, axes, tilt = FLOWS[flow]
        self.M = turn_about_z(tilt) @ np.diag(axes) @ turn_about_z(tilt).T
        self.fine_degree = degree + degree // 2  # of the force density, a product
        self.fine = Grid(self.fine_degree, degree)
        self.targets = Grid(degree + 4, degree)
        self.to_fine = self.fine.projection(self.fine_degree)
        self.to_shape = self.targets.projection(degree)
        self.prepare_polar_rules(2 * degree)
        numbers = orders(self.fine_degree)
        self.cosines = np.array([k for k, (l, m) in enumerate(numbers) if m and numbers[k - 1] != (l, m)])
        self.waves = np.array([numbers[k][1] for k in self.cosines])
        self.s = self.to_shape @ (1 / np.linalg.norm(self.targets.directions[0] @ self.M.T, axis=1))  # unit sphere

    def prepare_polar_rules(self, points):
        """For a target at phi = 0 on each ring of the upper half: directions and harmonics of its polar rule."""
        x, w = np.polynomial.legendre.leggauss(points)
        polar, around = np.meshgrid(0.5 * np.pi * (x + 1), np.pi * (np.arange(2 * points) + 0.5) / points, indexing="ij")
        self.rule_weights = np.repeat(0.5 * np.pi * w * np.pi / points, 2 * points) * np.sin(polar).ravel()
        local = directions(polar.ravel(), around.ravel())[0]
        self.rules = []
        for ring in range((self.targets.rings + 1) // 2):
            theta = self.targets.theta[ring * self.targets.around]
            c, s = np.cos(theta), np.sin(theta)
            y = local @ np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]]).T
            angles = np.arccos(np.clip(y[:, 2], -1, 1)), np.arctan2(y[:, 1], y[:, 0])
            self.rules.append((y, harmonics(self.fine_degree, *angles)))

    def geometry(self, grid, s):
        """x, n, |x_t x x_p| and kappa = k1 + k2 (2 on the unit sphere) on a grid."""
        v, v_t, v_p, v_tt, v_tp, v_pp = ((b @ s)[:, None] for b in grid.harmonics)
        y, y_t, y_p, y_tt, y_tp, y_pp = grid.directions
        x = v * y @ self.M.T
        x_t = (v_t * y + v * y_t) @ self.M.T
        x_p = (v_p * y + v * y_p) @ self.M.T
        x_tt = (v_tt * y + 2 * v_t * y_t + v * y_tt) @ self.M.T
        x_tp = (v_tp * y + v_t * y_p + v_p * y_t + v * y_tp) @ self.M.T
        x_pp = (v_pp * y + 2 * v_p * y_p + v * y_pp) @ self.M.T
        dot = lambda a, b: np.einsum("ij,ij->i", a, b)
        area = np.cross(x_t, x_p)
        J = np.linalg.norm(area, axis=1)
        n = area / J[:, None]
        E, F, G = dot(x_t, x_t), dot(x_t, x_p), dot(x_p, x_p)
        kappa = -(E * dot(x_pp, n) - 2 * F * dot(x_tp, n) + G * dot(x_tt, n)) / (E * G - F * F)
        return x, n, J, kappa

    def turned(self, coefficients, angle):
        """Coefficients of the same fields in a frame turned by an angle about z."""
        result = coefficients.copy()
        c, s = np.cos(self.waves * angle)[:, None], np.sin(self.waves * angle)[:, None]
        a, b = coefficients[self.cosines], coefficients[self.cosines + 1]
        result[self.cosines], result[self.cosines + 1] = c * a + s * b, c * b - s * a
        return result

    def single_layer(self, s, targets):
        """oint (I/r + r r/r^3) . n kappa dS at the targets: a quarter computed, the rest by the flow's symmetries."""
        _, n, J, kappa = self.geometry(self.fine, s)
        density = (kappa * J / np.sin(self.fine.theta))[:, None] * n
        shape = np.zeros((self.fine_degree + 1) ** 2)
        shape[: len(s)] = s
        fields = np.column_stack([shape, self.to_fine @ density])
        around, half = self.targets.around, self.targets.around // 2
        result = np.zeros_like(targets)
        for ring, (y, basis) in enumerate(self.rules):
            angles = self.targets.phi[:half]
            values = basis @ np.concatenate([self.turned(fields, angle) for angle in angles], axis=1)
            for j, angle in enumerate(angles):
                k = ring * around + j
                stretch, force = values[:, 4 * j:4 * j + 1], values[:, 4 * j + 1:4 * j + 4] * self.rule_weights[:, None]
                r = targets[k] - (stretch * (y @ turn_about_z(angle).T)) @ self.M.T
                d = np.linalg.norm(r, axis=1)[:, None]
                result[k] = (force / d + r * np.einsum("ij,ij->i", r, force)[:, None] / d**3).sum(axis=0)
                result[k + half] = result[k] * [-1, -1, 1]
        for ring in range(len(self.rules), self.targets.rings):
            mirror = self.targets.rings - 1 - ring
            result[ring * around:(ring + 1) * around] = result[mirror * around:(mirror + 1) * around] * [1, 1, -1]
        return result

    def rate(self, s):
        """ds/dt in the flow."""
        x, n, _, _ = self.geometry(self.targets, s)
        v = -self.single_layer(s, x) / (8 * np.pi * self.Ca)
        v += x @ self.G.T
        along = self.targets.directions[0] @ self.M.T
        return self.to_shape @ (np.einsum("ij,ij->i", v, n) / np.einsum("ij,ij->i", n, along))

    def step(self, dt):
        k1 = self.rate(self.s)
        k2 = self.rate(self.s + dt / 2 * k1)
        k3 = self.rate(self.s + dt / 2 * k2)
        k4 = self.rate(self.s + dt * k3)
        self.s = self.s + dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4)

    def measures(self):
        """D, L, B, W, extent_x as in docs/notation.md."""
        phi = 2 * np.pi * np.arange(4000) / 4000
        equator = np.full_like(phi, np.pi / 2)
        x = (harmonics(self.degree, equator, phi) @ self.s)[:, None] * (directions(equator, phi)[0] @ self.M.T)
        r = np.hypot(x[:, 0], x[:, 1])
        pole = harmonics(self.degree, np.zeros(1), np.zeros(1)) @ self.s
        L, B = peak(r), -peak(-r)
        return (L - B) / (L + B), L, B, pole[0] * self.M[2, 2], peak(x[:, 0])

    def moments(self):
        """Volume, and D_inertia as in docs/notation.md."""
        x, n, J, _ = self.geometry(self.fine, self.s)
        flux = self.fine.weights * J / np.sin(self.fine.theta) * np.einsum("ij,ij->i", x, n)
        axes = np.sqrt(np.linalg.eigvalsh(np.einsum("i,ij,ik->jk", flux, x, x)))  # but for one factor
        return flux.sum() / 3, (axes[2] - axes[0]) / (axes[2] + axes[0])


def peak(values):
    """Largest value of a periodic sequence, by the parabola through the three around it."""
    k = int(np.argmax(values))
    a, b, c = values[k - 1], values[k], values[(k + 1) % len(values)]
    return b + (a - c) ** 2 / (8 * (2 * b - a - c))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("Ca", type=float)
    parser.add_argument("--flow", choices=FLOWS, default="shear")
    parser.add_argument("--degree", type=int, default=20)
    parser.add_argument("--dt", type=float, default=0.1)
    parser.add_argument("--end", type=float, default=20.0)
    parser.add_argument("--interval", type=float, default=1.0)
    options = parser.parse_args()

    drop = Drop(options.Ca, options.degree, options.flow)
    print("t,D,L,B,W,extent_x,D_inertia,volume_drift")
    for k in range(round(options.end / options.dt) + 1):
        if k > 0:
            drop.step(options.dt)
        if k % round(options.interval / options.dt) == 0:
            volume, inertia = drop.moments()
            print(f"{k * options.dt:g}," + ",".join(f"{value:.6f}" for value in (*drop.measures(), inertia))
                  + f",{volume / (4 * np.pi / 3) - 1:.1e}", flush=True)


if __name__ == "__main__":
    main()
