"""Input files of MoorDyn, a platform to moor, and the line of a table at rest."""

from __future__ import annotations

import math
import tomllib
from pathlib import Path
from typing import Any

import numpy as np

import hydrodae

#: Three lines as in RM3 of SEA-Stack, each with a float; the format of version 2.
RM3 = """--------------------- MoorDyn Input File ------------------------------------
RM3 with three lines
---------------------- LINE TYPES -----------------------------------------------------
TypeName   Diam   Mass/m   EA         BA/-zeta   EI    Cd    Ca    CdAx   CaAx
(name)     (m)    (kg/m)   (N)        (N-s/-)    (-)   (-)   (-)   (-)    (-)
chain      0.144  126.0    583.376e6  -0.8       0     1.6   1.0   0.05   0.0
---------------------- BODIES ---------------------------------------------------------
ID   Attachment  X0   Y0   Z0     r0   p0   y0   Mass  CG   I   Volume  CdA   Ca
(#)   (word)     (m)  (m)  (m)   (deg) (deg) (deg)  (kg) (m) (kg-m^2) (m^3) (m^2) (-)
1     Coupled     0    0   -21.5   0    0    0      0     0    0   0       0     0
---------------------- POINTS ---------------------------------------------------------
ID   Attachment  X       Y        Z      Mass    Volume  CdA     Ca
(#)   (word/ID)  (m)     (m)      (m)    (kg)    (m^3)   (m^2)   (-)
1    Fixed      -267      0       -70     0       0       0       0
2    Free        -40      0       -10     16755   33.51   12.566  1.0   ! a float
3    Body1        -3      0        11.5   0       0       0       0
4    Fixed       133.5  231.229   -70     0       0       0       0
5    Free         20     34.641   -10     16755   33.51   12.566  1.0
6    Body1        1.5     2.598    11.5   0       0       0       0
7    Fixed       133.5 -231.229   -70     0       0       0       0
8    Free         20    -34.641   -10     16755   33.51   12.566  1.0
9    Body1        1.5    -2.598    11.5   0       0       0       0
---------------------- LINES ----------------------------------------------------------
ID   LineType   AttachA  AttachB  UnstrLen  NumSegs  LineOutputs
(#)   (name)     (ID)     (ID)      (m)       (-)      (-)
1     chain       1        2        240        15       -
2     chain       2        3        40         5        -
3     chain       4        5        240        15       -
4     chain       5        6        40         5        -
5     chain       7        8        240        15       -
6     chain       9        8        40         5        -
---------------------- OPTIONS --------------------------------------------------------
2         writeLog     Write a log file
0.01      dtM          time step (s)
3.0e6     kb           bottom stiffness (Pa/m)
1000.0    rho          water density (kg/m^3)
70        WtrDpth      water depth (m)
---------------------- OUTPUTS --------------------------------------------------------
FairTen1
END
------------------------- need this line ----------------------------------------------
"""

OLD = """MoorDyn input file for version 1
True          Echo
---------------------- LINE DICTIONARY ------------------------------------
LineType Diam MassDenInAir EA BA/-zeta Can Cat Cdn Cdt
(-) (m) (kg/m) (N) (Pa-s/-) (-) (-) (-) (-)
main 0.252 390 1.674e9 -1 1 0 1.37 0.64
---------------------- NODE PROPERTIES ------------------------------------
Node Type X Y Z M V FX FY FZ CdA CA
(-) (-) (m) (m) (m) (kg) (m^3) (kN) (kN) (kN) (m^2) (-)
1 Vessel 0 0 0 0 0 0 0 0 0 0
2 Fix {x} 0 {z} 0 0 0 0 0 0 0
---------------------- LINE PROPERTIES ------------------------------------
Line LineType UnstrLen NumSegs NodeAnch NodeFair Flags/Outputs
(-) (-) (m) (-) (-) (-) (-)
1 main {length} 41 2 1 p
---------------------- SOLVER OPTIONS -------------------------------------
1e-3 dtM time step
9.81 g gravity
{depth} WtrDpth water depth
---------------------- OUTPUTS --------------------------------------------
FairTen1
END
"""


def written(folder: Path, text: str) -> Path:
    """Write an input file."""
    path = folder / "lines.txt"
    path.write_text(text)
    return path


def tables(text: str) -> dict[str, list[dict[str, Any]]]:
    return tomllib.loads(text)


def held(force: dict[str, Any]) -> hydrodae.Catenary:
    """The line of a table, in the reference pose."""
    d = np.subtract(force["point_b"], force["point_a"])
    return hydrodae.catenary(
        math.hypot(d[0], d[1]),
        d[2],
        force["length"],
        force["weight"],
        force["stiffness"],
        loads=force.get("loads", ()),
        dry_weight=force.get("dry_weight"),
        dry_loads=force.get("dry_loads", ()),
        surface=-force["point_a"][2],
        seabed=force.get("seabed", True),
        friction=force.get("friction", 0.0),
    )


LOWE_LANGLEY = """Jumper of Lowe and Langley (2006)
--- LINE TYPES ---
TypeName   Diam   Mass/m   EA     BA    EI       Cd    Ca    CdAx   CaAx
(name)     (m)    (kg/m)   (N)   (N-s)  (N-m^2)  (-)   (-)   (-)    (-)
jumper     0.396  165.0    5e8    0     1.208e5  1.0   1.0   0.0    0.0
--- POINTS ---
ID   Attachment  X       Y     Z      Mass   Volume  CdA    Ca
(#)   (word/ID)  (m)     (m)   (m)    (kg)   (m^3)   (m^2)  (-)
1    Fixed      -100      0    -55     0      0       0      0
2    Coupled       0      0     -5     0      0       0      0
--- LINES ---
ID   LineType   AttachA  AttachB  UnstrLen  NumSegs  LineOutputs
(#)   (name)     (ID)     (ID)      (m)       (-)      (-)
1     jumper      1        2        170        68       -
--- OPTIONS ---
1000     rho        water density
9.807    g          gravity
100      WtrDpth    water depth
--- need this line ---
"""
BRIDLE = """One leg with a bridle
--- LINE TYPES ---
TypeName   Diam   Mass/m   EA     BA/-zeta  EI   Cd    Ca    CdAx   CaAx
(name)     (m)    (kg/m)   (N)    (N-s/-)   (-)  (-)   (-)   (-)    (-)
chain      0.2    200.0    1e9    0         0    0     0     0      0
--- POINTS ---
ID   Attachment  X     Y    Z      Mass   Volume  CdA    Ca
(#)   (word/ID)  (m)   (m)  (m)    (kg)   (m^3)   (m^2)  (-)
1    Fixed       390    0   -50     0      0       0      0
2    Free         60    0   -12     2000   1.0     2.0    0.5
3    Coupled       5    8   -2      0      0       0      0
4    Coupled       5   -8   -2      0      0       0      0
--- LINES ---
ID   LineType   AttachA  AttachB  UnstrLen  NumSegs  LineOutputs
(#)   (name)     (ID)     (ID)      (m)       (-)      (-)
1     chain       1        2        340        34       -
2     chain       2        3        56         7        -
3     chain       2        4        56         7        -
--- OPTIONS ---
50      WtrDpth    water depth
1       WaveKin    waves
"""

PLATFORM = """
[[body]]
name = "platform"
motion = ["heave"]
mass = 1e6
center_of_gravity = [0.0, 0.0, 0.0]
[[force]]
type = "mooring_matrix"
name = "water"
body = "platform"
stiffness = [0.0, 0.0, 1e7, 0.0, 0.0, 0.0]
pretension = [0.0, 0.0, 9.81e6, 0.0, 0.0, 0.0]
[environment]
water_density = 1025.0
[solver]
end_time = 1.0
"""
LAZY = """Heavy, buoyant and heavy parts
--- LINE TYPES ---
TypeName   Diam   Mass/m   EA     BA/-zeta  EI   Cd    Ca    CdAx   CaAx
(name)     (m)    (kg/m)   (N)    (N-s/-)   (-)  (-)   (-)   (-)    (-)
heavy      0.2    110.0    4e8    -1.0      0    1.0   1.0   0      0
light      0.4    75.0     4e8    -1.0      0    1.0   1.0   0      0
--- POINTS ---
ID   Attachment  X     Y    Z      Mass   Volume  CdA    Ca
(#)   (word/ID)  (m)   (m)  (m)    (kg)   (m^3)   (m^2)  (-)
1    Fixed      -800    0   -300    0      0       0      0
2    Free       -500    0   -290    0      0       0      0
3    Free       -300    0   -200    0      0       0      0
4    Coupled     0      0    0      0      0       0      0
--- LINES ---
ID   LineType   AttachA  AttachB  UnstrLen  NumSegs  LineOutputs
(#)   (name)     (ID)     (ID)      (m)       (-)      (-)
1     heavy       1        2        360        60       -
2     light       2        3        240        40       -
3     heavy       3        4        360        60       -
--- OPTIONS ---
1000    rho        density
300     WtrDpth    depth
"""
#: A buoyant float between two chains, MoorDyn's version 2.
FLOAT = """A float of 120 m3 at the surface
--- LINE TYPES ---
TypeName Diam Mass/m EA BA/-zeta EI Cd Ca CdAx CaAx
(name) (m) (kg/m) (N) (N-s/-) (N-m^2) (-) (-) (-) (-)
chain 0.12 180.0 6.0e8 -1.0 0 1.2 1.0 0.2 0.0
--- POINTS ---
ID Attachment X Y Z M V CdA CA
(#) (-) (m) (m) (m) (kg) (m^3) (m^2) (-)
1 Fixed -600 0 -150 0 0 0 0
2 Free -300 0 -40 500 120 0 0
3 Free -200 0 -60 0 0 0 0
4 Coupled -20 0 -10 0 0 0 0
--- LINES ---
ID LineType AttachA AttachB UnstrLen NumSegs Outputs
(#) (name) (#) (#) (m) (-) (-)
1 chain 1 2 330 40 p
2 chain 2 3 100 8 p
3 chain 3 4 260 40 p
--- OPTIONS ---
150 WtrDpth
"""
#: One chain that lies on a bed with friction.
LYING = """A chain on a bed with friction
--- LINE TYPES ---
TypeName Diam Mass/m EA BA/-zeta EI Cd Ca CdAx CaAx
(name) (m) (kg/m) (N) (N-s/-) (N-m^2) (-) (-) (-) (-)
chain 0.12 180.0 6.0e8 -1.0 0 1.2 1.0 0.2 0.0
--- POINTS ---
ID Attachment X Y Z M V CdA CA
(#) (-) (m) (m) (m) (kg) (m^3) (m^2) (-)
1 Fixed -600 0 -150 0 0 0 0
2 Coupled -20 0 -10 0 0 0 0
--- LINES ---
ID LineType AttachA AttachB UnstrLen NumSegs Outputs
(#) (name) (#) (#) (m) (-) (-)
1 chain 1 2 610 100 p
--- OPTIONS ---
0.7 FrictionCoefficient
150 WtrDpth
"""
#: A rod that hangs level on two ropes, 3 m from its ends to the ground above.
HANGING = """A rod on two ropes
--- LINE TYPES ---
TypeName Diam Mass/m EA BA/-zeta EI Cd Ca CdAx CaAx
(name) (m) (kg/m) (N) (N-s/-) (N-m^2) (-) (-) (-) (-)
rope 0.05 4.0 1e9 -0.5 0 1.2 1.0 0.1 0.0
--- ROD TYPES ---
TypeName Diam Mass/m Cd Ca CdEnd CaEnd
(name) (m) (kg/m) (-) (-) (-) (-)
bar 0.5 900 1.1 1.0 0.8 0.6
--- BODIES ---
ID Attachment X0 Y0 Z0 r0 p0 y0 Mass CG* I* Volume CdA* Ca
(#) (-) (m) (m) (m) (deg) (deg) (deg) (kg) (m) (kg-m^2) (m^3) (m^2) (-)
{bodies}--- RODS ---
ID RodType Attachment Xa Ya Za Xb Yb Zb NumSegs RodOutputs
(#) (name) (#/key) (m) (m) (m) (m) (m) (m) (-) (-)
{rods}
--- POINTS ---
ID Attachment X Y Z M V CdA CA
(#) (-) (m) (m) (m) (kg) (m^3) (m^2) (-)
1 Fixed -5 0 -10 0 0 0 0
2 Fixed 5 0 -10 0 0 0 0
{points}--- LINES ---
ID LineType AttachA AttachB UnstrLen NumSegs Outputs
(#) (name) (#) (#) (m) (-) (-)
1 rope 1 {a} 10 {n} p
2 rope 2 {b} 10 {n} p
--- OPTIONS ---
{depth}
--- need this line ---
"""
ROD = "1 bar Free -5 0 -20 5 0 -20 10 -"


def hanging(
    folder: Path,
    rods: str = ROD,
    *,
    bodies: str = "",
    points: str = "",
    ends: tuple[str, str] = ("R1A", "r1b"),
    n: int = 5,
    depth: str = "50 WtrDpth",
) -> Path:
    """Write that file with other rods, bodies, points, ends of lines, segments or options."""
    text = HANGING.format(
        rods=rods, bodies=bodies, points=points, a=ends[0], b=ends[1], n=n, depth=depth
    )
    return written(folder, text)
