"""Fits the polynomial P of shaders/interactions/gravity_ewald.wgsl, and says how good it is.

The law between two is h(r) = 1 / r - (2 / L) P(1 - (2 r / L)^2) up to half a side, and nothing beyond. With t = 2 r / L, the
part t P(1 - t^2) of a mass is smeared over what is nearer than t; its derivative is a window w(t), even, of the integral 1
over 0 <= t <= 1, and the wave k of the rest has 4 pi / k^2 times the Fourier transform of w. Windows are sums of
(1 - t^2)^j, j = 2 ... 8: j = 2 is the least whose force ends with its slope. Of these the one is taken that leaves the least
force, in the mean square over the cube, in waves beyond |k|^2 = 14.

    python3 -m venv v && v/bin/pip install numpy && v/bin/python benches/ewald_split.py
"""

from math import comb

import numpy as np

SHELLS, POWERS, FAR = 14, range(2, 9), 40

# How many waves there are of each |k|^2.
axis = np.arange(-FAR, FAR + 1) ** 2
squares = (axis[:, None, None] + axis[None, :, None] + axis[None, None, :]).ravel()
number = np.bincount(squares[squares <= FAR * FAR])
k2 = np.nonzero(number)[0][1:]

# Each window, and its transform.
t, weight = np.polynomial.legendre.leggauss(200)
t, weight = 0.5 * (t + 1), 0.5 * weight
windows = np.array([(1 - t * t) ** j for j in POWERS])
area = windows @ weight
transform = (windows * weight) @ np.cos(np.pi * np.outer(t, np.sqrt(k2)))

# The force of the waves k and -k together is 4 w(k) / k times a sine: the mean square of all that are left out.
left = k2 > SHELLS
cost = (transform[:, left] * (4 * number[k2[left]] / k2[left])) @ transform[:, left].T
mix = np.linalg.solve(cost, area)
mix /= mix @ area
print(f"waves: {number[1:SHELLS + 1].sum() // 2} of |k|^2 <= {SHELLS}")
print(f"left out, root mean square: {np.sqrt(mix @ cost @ mix):.2e} G M / L^2")

# t P(1 - t^2) is the integral of the window; in powers of t^2, then of v = 1 - t^2.
window = np.zeros(POWERS[-1] + 1)
for part, j in zip(mix, POWERS):
    window[: j + 1] += part * np.array([comb(j, i) * (-1.0) ** i for i in range(j + 1)])
smeared = window / (2 * np.arange(len(window)) + 1)
taper = [sum(smeared[j] * comb(j, i) * (-1.0) ** i for j in range(i, len(smeared))) for i in range(len(smeared))]
print("P:", ", ".join(f"{c:.6f}" for c in taper))
