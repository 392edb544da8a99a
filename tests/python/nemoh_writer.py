"""Writes Nemoh folders from arrays, in the layouts that real programs use; for tests of readers.

Written independently of the reader, after the Fortran formats of Nemoh's Results.f90.
"""

from __future__ import annotations

import numpy as np


class NemohFolder:
    """A Nemoh folder with known content; change fields, then `write`.

    Attributes
    ----------
    motions, forces : list per body of (type, direction, point)
    added_mass, damping : callables (w, force, motion) -> value, indices from 0
    force : callable (w, heading_deg, force) -> complex in Nemoh's convention e^{-iwt}
    """

    def __init__(self, bodies=1, omega=(0.5, 1.0, 1.5, 2.0, 2.5)):
        six = [(k, d, (0.0, 0.0, -1.0)) for k in (1, 2) for d in np.eye(3)]
        self.motions = [list(six) for _ in range(bodies)]
        self.forces = [list(six) for _ in range(bodies)]
        self.mesh = [f"mesh\\body{i + 1}.dat" for i in range(bodies)]
        self.omega = np.array(omega, dtype=float)
        self.heading_deg = [0.0]
        self.depth, self.rho, self.gravity, self.origin = 0.0, 1000.0, 9.81, (0.0, 0.0)
        self.frequency_line = None
        self.variable = '"w (rad/s)"'
        self.first_column = lambda w: w
        self.added_mass = lambda w, i, j: 1000.0 * (i == j) + 10 * i + j + w
        self.damping = lambda w, i, j: 500.0 * (i == j) * w * np.exp(-w)
        self.force = lambda w, h, i: (100.0 + i) * np.exp(0.1j * (i + 1))
        self.split = None  # share of the excitation that is Froude-Krylov
        self.names = ("Nemoh.cal", "Results")

    def write(self, folder):
        results = folder / self.names[1]
        results.mkdir(parents=True)
        (folder / self.names[0]).write_text(self.cal())
        (results / "RadiationCoefficients.tec").write_text(self.radiation())
        (results / "ExcitationForce.tec").write_text(self.forces_tec("Diffraction force", 1.0))
        if self.split is not None:
            fk = self.forces_tec("FKforce", self.split, unit="")
            (results / "FKForce.tec").write_text(fk)
            d = self.forces_tec("Diffraction force", 1.0 - self.split)
            (results / "DiffractionForce.tec").write_text(d)
        return folder

    def cal(self):
        w = self.omega
        h = self.heading_deg
        lines = [
            "--- Environment",
            f"{self.rho} ! RHO ! KG/M**3",
            f"{self.gravity}\t! G",
            f"{self.depth} ! DEPTH",
            f"{self.origin[0]} {self.origin[1]} ! XEFF YEFF",
            "--- Description of floating bodies",
            f"{len(self.motions)} ! Number of bodies",
        ]
        for mesh, motions, forces in zip(self.mesh, self.motions, self.forces, strict=True):
            lines += ["--- Body", f"{mesh} ! Name of mesh file", "100 90 ! points, panels"]
            for modes in (motions, forces):
                lines.append(f"{len(modes)} ! number")
                for kind, direction, point in modes:
                    numbers = " ".join(f"{v:g}" for v in (*direction, *point))
                    lines.append(f"{kind} {numbers} ! a 6 DoF 99 comment")
            lines.append("0 ! Number of lines of additional information")
        lines += [
            "--- Load cases",
            self.frequency_line or f"{w.size} {w[0]} {w[-1]} ! Number of wave frequencies",
            f"{len(h)} {h[0]} {h[-1]} ! headings",
            "--- Post processing",
        ]
        return "\n".join(lines) + "\n"

    def modes(self, table):
        return [(b + 1, d + 1) for b, modes in enumerate(table) for d in range(len(modes))]

    def radiation(self):
        motions, forces = self.modes(self.motions), self.modes(self.forces)
        lines = [f"VARIABLES={self.variable}"]
        lines += [f'"A {b:3d} {d:3d}" "B {b:3d} {d:3d}"' for b, d in forces]
        for j, (b, d) in enumerate(motions):
            lines.append(
                f'Zone t="Motion of body {b:4d} in DoF {d:3d}",I={self.omega.size:6d},F=POINT'
            )
            for w in self.omega:
                row = [self.first_column(w)]
                for i in range(len(forces)):
                    row += [self.added_mass(w, i, j), self.damping(w, i, j)]
                lines += fortran_lines(row)
        return "\n".join(lines) + "\n"

    def forces_tec(self, title, share, unit=" deg"):
        forces = self.modes(self.forces)
        lines = [f"VARIABLES={self.variable}"]
        lines += [f'"abs(F {b:3d} {d:3d})" "angle(F {b:3d} {d:3d})"' for b, d in forces]
        for h in self.heading_deg:
            lines.append(f'Zone t="{title} - beta = {h:7.3f}{unit}",I={self.omega.size:6d},F=POINT')
            for w in self.omega:
                row = [self.first_column(w)]
                for i in range(len(forces)):
                    f = share * self.force(w, h, i)
                    row += [abs(f), np.angle(f)]
                lines += fortran_lines(row)
        return "\n".join(lines) + "\n"


def fortran_lines(row):
    """Format 80(X,E14.7): at most 80 numbers on a line."""
    return ["".join(f" {fortran(v):>14s}" for v in row[i : i + 80]) for i in range(0, len(row), 80)]


def fortran(value):
    """E14.7 as Fortran prints it: 0.1234567E+01."""
    if value == 0.0:
        return "0.0000000E+00"
    exponent = int(np.floor(np.log10(abs(value)))) + 1
    mantissa = value / 10.0**exponent
    if abs(round(mantissa, 7)) >= 1.0:
        mantissa, exponent = mantissa / 10.0, exponent + 1
    letter = "E" if abs(exponent) < 100 else ""
    return f"{mantissa:.7f}{letter}{exponent:+03d}"
