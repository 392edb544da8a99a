"""What a result of a case owes to its database: step, range, length of memory, fit, coupling.

Each variant replaces A and B of the database and goes through the same linear model of the case
(`hydrodae.linear`). A memory cut at time T, and a fit, count by the A and B that they stand for:

    memory cut at T:  B - int_T^inf K cos(wt) dt,   A + (1/w) int_T^inf K sin(wt) dt
    fit:              B = Re H,                     A = A_inf + Im(H)/w

K(t) of a table that ends earlier, and its A_inf, come from what is left of B and A.
"""

from __future__ import annotations

from hydrodae.study.sensitivity.measure import Row, sensitivity

__all__ = ["Row", "sensitivity"]
