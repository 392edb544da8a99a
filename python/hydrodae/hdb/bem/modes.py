"""Own coordinates of bodies in a boundary-element run: pistons on pools, shapes by formula.

A mode is a field of displacement u(x, y, z) per unit amplitude. Its hydrostatic stiffness, that of
the pressure alone, is C_ij = -rho g int n.u_j (w_i + z div u_i) dS with w = u_z and normals into
the water (Newman 1994, Applied Ocean Research 16, 47): rows are loads, weight has no part in it.
"""

from __future__ import annotations

import ast
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from hydrodae.errors import CaseError
from hydrodae.hdb.labels import DOFS
from hydrodae.support.arrays import Array

FUNCTIONS: dict[str, Callable[..., Array]] = {
    name: getattr(np, name)
    for name in ("sin", "cos", "tan", "sinh", "cosh", "tanh", "exp", "sqrt", "abs", "sign")
} | {"min": np.minimum, "max": np.maximum}
OPERATORS: dict[type[ast.AST], Callable[..., Array]] = {
    ast.Add: np.add,
    ast.Sub: np.subtract,
    ast.Mult: np.multiply,
    ast.Div: np.divide,
    ast.Pow: np.power,
    ast.USub: np.negative,
    ast.UAdd: np.positive,
}
#: Step of the differences of a field, over the extent of the body.
STEP = 1e-5


@dataclass(frozen=True)
class Mode:
    """A mode at the centres of the n panels of a body, those of its pools last.

    Attributes
    ----------
    shape : (n, 3) array
        Displacement per unit amplitude [-].
    divergence : (n,) array
        [1/m].
    corners : (m, 4, 3) array or None
        Displacement of the corners of the m panels of the hull per unit amplitude [-]; None where
        the hull rests.
    """

    shape: Array
    divergence: Array
    corners: Array | None = None


def piston(before: int, count: int, after: int) -> Mode:
    """Return the mode whose `count` panels rise, between others that rest."""
    shape = np.zeros((before + count + after, 3))
    shape[before : before + count, 2] = 1.0
    return Mode(shape, np.zeros(len(shape)))


def by_formula(text: str, centers: Array) -> Mode:
    """Return the mode whose displacements are formulas of the place.

    Parameters
    ----------
    text : str
        Three formulas with commas between them, along x, y and z, or one along z. They have x, y, z
        [m] in the world, pi, numbers, + - * / ** and `FUNCTIONS`.
    centers : (n, 3) array
        Centres of the panels [m].

    Raises
    ------
    CaseError
        A formula cannot be read, or has no finite value at a panel.
    """
    trees = _parsed(text)
    shape = displacements(text, centers)
    step = STEP * max(float(np.ptp(centers, axis=0).max()), 1e-6)
    divergence = np.zeros(len(centers))
    for axis, tree in zip(np.eye(3), trees, strict=True):
        ahead, behind = (_value(text, tree, centers + s * axis) for s in (step, -step))
        divergence += (ahead - behind) / (2.0 * step)
    return Mode(shape, divergence)


def displacements(text: str, places: Array) -> Array:
    """Return the displacements (n, 3) [-] of formulas at places (n, 3) [m]; see `by_formula`."""
    return np.stack([_value(text, tree, places) for tree in _parsed(text)], axis=1)


def stiffness(panels: Array, point: Array, modes: list[Mode], rho: float, gravity: float) -> Array:
    """Return the hydrostatic stiffness (6 + m, 6 + m) of rigid motions and modes [N/m, N, N m].

    Parameters
    ----------
    panels : (n, 4, 3) array
        Wetted surface and pools [m]; normals into the water.
    point : (3,) array
        Reference point of the rotations [m].
    modes : list of Mode
    rho, gravity : float
        [kg/m3], [m/s2].
    """
    middle, area = centers_and_areas(panels)
    arm = middle - point
    rigid = [np.tile(axis, (len(middle), 1)) for axis in np.eye(3)]
    rigid += [np.cross(axis, arm) for axis in np.eye(3)]
    shapes = np.stack([*rigid, *(mode.shape for mode in modes)])
    spread = np.stack([*np.zeros((6, len(middle))), *(mode.divergence for mode in modes)])
    loads = shapes[..., 2] + middle[:, 2] * spread
    return np.asarray(-rho * gravity * loads @ np.einsum("jnk,nk->nj", shapes, area))


def centers_and_areas(panels: Array) -> tuple[Array, Array]:
    """Centres [m] and areas along the normals [m2] of panels (n, 4, 3), each (n, 3)."""
    parts = [panels[:, [0, 1, 2]], panels[:, [0, 2, 3]]]
    areas = [0.5 * np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]) for p in parts]
    sizes = [np.linalg.norm(a, axis=1)[:, None] for a in areas]
    middles = sum(p.mean(axis=1) * s for p, s in zip(parts, sizes, strict=True))
    return np.asarray(middles / (sizes[0] + sizes[1])), areas[0] + areas[1]


def check_names(body: str, names: list[str]) -> None:
    """Refuse names of modes that are doubled or those of rigid motions."""
    for name in names:
        if name in DOFS or names.count(name) > 1 or not name.replace("_", "").isalnum():
            raise CaseError(
                f"--mode {body}.{name}: expected a name of letters, digits and _ that no other "
                f"coordinate of {body} has"
            )


def _parsed(text: str) -> list[ast.expr]:
    """Trees of the formulas along x, y and z."""
    try:
        tree = ast.parse(text.strip(), mode="eval").body
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        raise CaseError(f"formula {text!r}: cannot be read; write it as 0.5*cos(pi*x/80)") from None
    if not isinstance(tree, ast.Tuple):
        return [ast.Constant(0.0), ast.Constant(0.0), tree]
    if len(tree.elts) != 3:
        raise CaseError(
            f"formula {text!r}: expected one formula, along z, or three along x, y and z"
        )
    return tree.elts


def _value(text: str, tree: ast.expr, places: Array) -> Array:
    """Value (n,) of a formula at places (n, 3)."""
    known = dict(zip("xyz", places.T, strict=True)) | {"pi": np.full(len(places), np.pi)}
    with np.errstate(all="ignore"):
        found = np.broadcast_to(_evaluated(text, tree, known), len(places)).astype(float)
    if not np.all(np.isfinite(found)):
        place = ", ".join(f"{v:.4g}" for v in places[int(np.argmin(np.isfinite(found)))])
        raise CaseError(f"formula {text!r}: no finite value at x, y, z = {place} m")
    return found


def _evaluated(text: str, node: ast.expr, known: dict[str, Array]) -> Array:
    def inner(other: ast.expr) -> Array:
        return _evaluated(text, other, known)

    match node:
        case ast.Constant(value=int() | float() as number) if not isinstance(number, bool):
            return np.asarray(float(number))
        case ast.Name(id=name) if name in known:
            return known[name]
        case ast.BinOp(op=op) if type(op) in OPERATORS:
            return OPERATORS[type(op)](inner(node.left), inner(node.right))
        case ast.UnaryOp(op=op) if type(op) in OPERATORS:
            return OPERATORS[type(op)](inner(node.operand))
        case ast.Call(func=ast.Name(id=name), keywords=[]) if name in FUNCTIONS:
            takes = 2 if name in ("min", "max") else 1
            if len(node.args) == takes:
                return FUNCTIONS[name](*map(inner, node.args))
    raise CaseError(
        f"formula {text!r}: {ast.unparse(node)!r} is unknown; it may have x, y, z, pi, numbers, "
        f"+ - * / ** and {', '.join(FUNCTIONS)}"
    )
