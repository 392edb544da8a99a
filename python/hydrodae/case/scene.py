"""Scenes built in Python instead of in a case file.

What type checkers and editors know of the class stands in ``scene.pyi``, which the build makes of
the same tables (``python/bindings/scene_stub.py``).
"""

from __future__ import annotations

from hydrodae.case.builder.base import SceneBase
from hydrodae.case.builder.methods import add_tables


class Scene(SceneBase):
    """A scene that is built call by call; `hydrodae.run` and the other functions take it.

    Each table of a case file is a method, its keys are the arguments: ``[[body]]`` is
    ``scene.body(name, mass=..., ...)``, ``[solver]`` is ``scene.solver(...)``. Where entries have
    a type, each type is a method: ``[[joint]] type = "revolute"`` is
    ``scene.joint.revolute(name, ...)``. A call checks its own values at once; `case`, `run` and
    `check` check the whole. Tables inside tables are dicts: ``initial={"angle_deg": 5.0}``.

    Parameters
    ----------
    title : str
        Title of the case.
    directory : path
        Folder that relative paths refer to (of the hydrodynamic database, of measured waves).

    Examples
    --------
    >>> scene = Scene(title="Pendulum")
    >>> arm = scene.body("arm", mass=1.0, center_of_gravity=[0, 0, -1], inertia=[0.1, 0.1, 0.1])
    >>> scene.joint.revolute("hinge", body_a="ground", body_b=arm, point=[0, 0, 0], axis=[0, 1, 0])
    'hinge'
    >>> scene.solver(end_time=1.0)
    >>> scene.case().joint_names
    ['hinge']
    >>> scene.body("buoy", mass=-1.0, center_of_gravity=[0, 0, 0])
    Traceback (most recent call last):
    hydrodae.errors.CaseError: scene.body("buoy"): key 'mass': must be >= 0 kg, got -1 kg
    """


add_tables(Scene)
