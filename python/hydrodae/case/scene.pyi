"""Scenes built in Python. Made by docs/reference.py from the fields of the kernel."""

from collections.abc import Sequence
from typing import Any, Literal, TypedDict

from numpy.typing import NDArray

from hydrodae.case.builder.base import SceneBase, TypedList

_Numbers = Sequence[float] | NDArray[Any]
_Rows = Sequence[_Numbers] | NDArray[Any]
_HydroAxes = Literal[
    "mean",
    "yaw",
    "body",
]
_HydroRadiation = Literal[
    "none",
    "constant",
    "exponential",
    "convolution",
]
_PoseTableCoordinate = Literal[
    "heave",
    "roll",
    "pitch",
    "yaw",
]
_PoseTableMemory = Literal[
    "rest",
    "blended",
]
_SeaPhase = Literal[
    "fixed",
    "moving",
]
_SeaStretching = Literal[
    "vertical",
    "wheeler",
    "extrapolated",
    "none",
]
_JonswapSpacing = Literal[
    "energy",
    "frequency",
]
_BodyMotion = Literal[
    "fixed",
    "planar",
    "point",
    "rigid",
    "surge",
    "sway",
    "heave",
    "roll",
    "pitch",
    "yaw",
]
_BodyHydrostatics = Literal[
    "linear",
    "mesh",
]
_BodyFroudeKrylov = Literal[
    "linear",
    "mesh",
]
_CoordinateLevel = Literal[
    "position",
    "velocity",
]
_MarkerAxes = Literal[
    "world",
    "body",
]
_MorisonSurface = Literal[
    "mean",
    "instantaneous",
]
_ValveDirection = Literal[
    "out",
    "in",
    "both",
]
_TcpProtocol = Literal[
    "hydrodae",
    "hotint",
]
_TcpRole = Literal[
    "server",
    "client",
]
_SolverMethod = Literal[
    "auto",
    "radau",
    "explicit_rk",
    "ida",
    "generalized_alpha",
    "gauss",
    "lobatto_iiic",
]
_SolverFormulation = Literal[
    "stabilised",
    "index_2",
    "index_3",
    "index_1",
]
_SolverStart = Literal[
    "given",
    "equilibrium",
]
_SolverAccuracy = Literal[
    "two_runs",
    "none",
]

class BodyInitial(TypedDict, total=False):
    """Table `initial` of `body`."""

    displacement: _Numbers
    rotation_deg: _Numbers
    velocity: _Numbers
    angular_velocity: _Numbers

class ModeInitial(TypedDict, total=False):
    """Table `initial` of `mode`."""

    amplitude: float
    rate: float

class RevoluteInitial(TypedDict, total=False):
    """Table `initial` of `revolute`."""

    angle_deg: float
    angle_rate: float

class PrismaticInitial(TypedDict, total=False):
    """Table `initial` of `prismatic`."""

    displacement: float
    displacement_rate: float

class UniversalInitial(TypedDict, total=False):
    """Table `initial` of `universal`."""

    angle_deg: float
    angle_rate: float

class CylindricalInitial(TypedDict, total=False):
    """Table `initial` of `cylindrical`."""

    angle_deg: float
    angle_rate: float
    displacement: float
    displacement_rate: float

class PlanarInitial(TypedDict, total=False):
    """Table `initial` of `planar`."""

    angle_deg: float
    angle_rate: float
    displacement: float
    displacement_rate: float

class SlidingInitial(TypedDict, total=False):
    """Table `initial` of `sliding`."""

    displacement: float
    displacement_rate: float

class ScrewInitial(TypedDict, total=False):
    """Table `initial` of `screw`."""

    angle_deg: float
    angle_rate: float
    displacement: float
    displacement_rate: float

class TelescopeInitial(TypedDict, total=False):
    """Table `initial` of `telescope`."""

    displacement: float
    displacement_rate: float

class PathInitial(TypedDict, total=False):
    """Table `initial` of `path`."""

    displacement: float
    displacement_rate: float

class CoordinateDrive(TypedDict, total=False):
    """Table `drive` of `coordinate`."""

    constant: float
    rate: float
    amplitude: float
    period: float
    phase_deg: float
    ramp: float
    time: _Numbers
    values: _Numbers
    python: bool

class WaveTypes(TypedList):
    """One wave system; the sea is the sum of all, and still without any."""

    def regular(
        self,
        name: str,
        *,
        height: float,
        period: float,
        heading_deg: float = ...,
        phase_deg: float = ...,
    ) -> str:
        """Add `[[wave]]` with the type "regular".

        One wave of one period: H/2 cos(w t - k.x + phase).

        Parameters
        ----------
        name : text
            Name of the wave system.
        heading_deg : number, deg, default 0
            Mean direction of travel; 0 = +x, 90 = +y. Allowed: -360 to 360.
        height : number, m
            Height H of a regular wave, crest to trough. Allowed: >= 0.
        period : number, s
            Period of a regular wave. Allowed: > 0.
        phase_deg : number, deg, default 0
            Phase of a regular wave: its crest passes the origin when w t = -phase.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def jonswap(
        self,
        name: str,
        *,
        significant_height: float,
        peak_period: float,
        heading_deg: float = ...,
        gamma: float = ...,
        spreading: float = ...,
        components: int = ...,
        spacing: _JonswapSpacing = ...,
        seed: int = ...,
        lost_variance: float = ...,
        frequency_range: _Numbers = ...,
    ) -> str:
        """Add `[[wave]]` with the type "jonswap".

        JONSWAP spectrum (Hasselmann et al. 1973).

        Parameters
        ----------
        name : text
            Name of the wave system.
        heading_deg : number, deg, default 0
            Mean direction of travel; 0 = +x, 90 = +y. Allowed: -360 to 360.
        significant_height : number, m
            Hs = 4 sqrt(m0). Allowed: >= 0.
        peak_period : number, s
            Period at which the spectrum is highest. Allowed: > 0.
        gamma : number, default 3.3
            Peak enhancement of JONSWAP. Allowed: 1 to 20.
        spreading : number, optional
            Exponent s of the directional spreading cos^2s((theta - heading)/2), cut at +-90
            deg; without it all waves travel along the heading. Allowed: 0.5 to 1000.
        components : integer, default 200
            Number of components of an irregular wave. Allowed: 2 to 100000.
        spacing : text, default "energy"
            Bins of equal energy or of equal width in frequency; each has one component at a
            frequency drawn at random in its bin, so that the sea does not repeat. Allowed:
            energy, frequency.
        seed : integer, default 1
            Seed of the random phases, frequencies and directions. Allowed: >= 0.
        lost_variance : number, optional
            Largest part of the variance that may lie outside the frequencies of the database
            and is left out; 0.02 by default for a record, 0.1 for a spectrum without
            frequency_range. Allowed: 0 to 1.
        frequency_range : list of numbers, rad/s, optional
            Lowest and highest frequency; default: all but 0.1 % of the energy below and 0.5 %
            above, as far as the database reaches. Allowed: > 0.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def bretschneider(
        self,
        name: str,
        *,
        significant_height: float,
        peak_period: float,
        heading_deg: float = ...,
        spreading: float = ...,
        components: int = ...,
        spacing: _JonswapSpacing = ...,
        seed: int = ...,
        lost_variance: float = ...,
        frequency_range: _Numbers = ...,
    ) -> str:
        """Add `[[wave]]` with the type "bretschneider".

        JONSWAP spectrum with gamma = 1.

        Parameters
        ----------
        name : text
            Name of the wave system.
        heading_deg : number, deg, default 0
            Mean direction of travel; 0 = +x, 90 = +y. Allowed: -360 to 360.
        significant_height : number, m
            Hs = 4 sqrt(m0). Allowed: >= 0.
        peak_period : number, s
            Period at which the spectrum is highest. Allowed: > 0.
        spreading : number, optional
            Exponent s of the directional spreading cos^2s((theta - heading)/2), cut at +-90
            deg; without it all waves travel along the heading. Allowed: 0.5 to 1000.
        components : integer, default 200
            Number of components of an irregular wave. Allowed: 2 to 100000.
        spacing : text, default "energy"
            Bins of equal energy or of equal width in frequency; each has one component at a
            frequency drawn at random in its bin, so that the sea does not repeat. Allowed:
            energy, frequency.
        seed : integer, default 1
            Seed of the random phases, frequencies and directions. Allowed: >= 0.
        lost_variance : number, optional
            Largest part of the variance that may lie outside the frequencies of the database
            and is left out; 0.02 by default for a record, 0.1 for a spectrum without
            frequency_range. Allowed: 0 to 1.
        frequency_range : list of numbers, rad/s, optional
            Lowest and highest frequency; default: all but 0.1 % of the energy below and 0.5 %
            above, as far as the database reaches. Allowed: > 0.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def pierson_moskowitz(
        self,
        name: str,
        *,
        significant_height: float,
        heading_deg: float = ...,
        spreading: float = ...,
        components: int = ...,
        spacing: _JonswapSpacing = ...,
        seed: int = ...,
        lost_variance: float = ...,
        frequency_range: _Numbers = ...,
    ) -> str:
        """Add `[[wave]]` with the type "pierson_moskowitz".

        Spectrum of a fully grown wind sea; its period follows from Hs.

        Parameters
        ----------
        name : text
            Name of the wave system.
        heading_deg : number, deg, default 0
            Mean direction of travel; 0 = +x, 90 = +y. Allowed: -360 to 360.
        significant_height : number, m
            Hs = 4 sqrt(m0). Allowed: >= 0.
        spreading : number, optional
            Exponent s of the directional spreading cos^2s((theta - heading)/2), cut at +-90
            deg; without it all waves travel along the heading. Allowed: 0.5 to 1000.
        components : integer, default 200
            Number of components of an irregular wave. Allowed: 2 to 100000.
        spacing : text, default "energy"
            Bins of equal energy or of equal width in frequency; each has one component at a
            frequency drawn at random in its bin, so that the sea does not repeat. Allowed:
            energy, frequency.
        seed : integer, default 1
            Seed of the random phases, frequencies and directions. Allowed: >= 0.
        lost_variance : number, optional
            Largest part of the variance that may lie outside the frequencies of the database
            and is left out; 0.02 by default for a record, 0.1 for a spectrum without
            frequency_range. Allowed: 0 to 1.
        frequency_range : list of numbers, rad/s, optional
            Lowest and highest frequency; default: all but 0.1 % of the energy below and 0.5 %
            above, as far as the database reaches. Allowed: > 0.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def ochi_hubble(
        self,
        name: str,
        *,
        significant_height: float,
        peak_period: float,
        heading_deg: float = ...,
        shape: float = ...,
        spreading: float = ...,
        components: int = ...,
        spacing: _JonswapSpacing = ...,
        seed: int = ...,
        lost_variance: float = ...,
        frequency_range: _Numbers = ...,
    ) -> str:
        """Add `[[wave]]` with the type "ochi_hubble".

        One part of the spectrum of Ochi and Hubble (1976); the other part is a wave system of
        its own.

        Parameters
        ----------
        name : text
            Name of the wave system.
        heading_deg : number, deg, default 0
            Mean direction of travel; 0 = +x, 90 = +y. Allowed: -360 to 360.
        significant_height : number, m
            Hs = 4 sqrt(m0). Allowed: >= 0.
        peak_period : number, s
            Period at which the spectrum is highest. Allowed: > 0.
        shape : number, default 1
            Shape l of Ochi-Hubble. Allowed: 0.5 to 20.
        spreading : number, optional
            Exponent s of the directional spreading cos^2s((theta - heading)/2), cut at +-90
            deg; without it all waves travel along the heading. Allowed: 0.5 to 1000.
        components : integer, default 200
            Number of components of an irregular wave. Allowed: 2 to 100000.
        spacing : text, default "energy"
            Bins of equal energy or of equal width in frequency; each has one component at a
            frequency drawn at random in its bin, so that the sea does not repeat. Allowed:
            energy, frequency.
        seed : integer, default 1
            Seed of the random phases, frequencies and directions. Allowed: >= 0.
        lost_variance : number, optional
            Largest part of the variance that may lie outside the frequencies of the database
            and is left out; 0.02 by default for a record, 0.1 for a spectrum without
            frequency_range. Allowed: 0 to 1.
        frequency_range : list of numbers, rad/s, optional
            Lowest and highest frequency; default: all but 0.1 % of the energy below and 0.5 %
            above, as far as the database reaches. Allowed: > 0.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def table(
        self,
        name: str,
        *,
        frequency: _Numbers,
        density: _Numbers,
        heading_deg: float = ...,
        spreading: float = ...,
        components: int = ...,
        spacing: _JonswapSpacing = ...,
        seed: int = ...,
        lost_variance: float = ...,
        frequency_range: _Numbers = ...,
    ) -> str:
        """Add `[[wave]]` with the type "table".

        Spectrum given point by point, straight lines between.

        Parameters
        ----------
        name : text
            Name of the wave system.
        heading_deg : number, deg, default 0
            Mean direction of travel; 0 = +x, 90 = +y. Allowed: -360 to 360.
        frequency : list of numbers, rad/s
            Frequencies of a table, ascending. Allowed: > 0.
        density : list of numbers, m2 s/rad
            Spectral density S at these frequencies. Allowed: >= 0.
        spreading : number, optional
            Exponent s of the directional spreading cos^2s((theta - heading)/2), cut at +-90
            deg; without it all waves travel along the heading. Allowed: 0.5 to 1000.
        components : integer, default 200
            Number of components of an irregular wave. Allowed: 2 to 100000.
        spacing : text, default "energy"
            Bins of equal energy or of equal width in frequency; each has one component at a
            frequency drawn at random in its bin, so that the sea does not repeat. Allowed:
            energy, frequency.
        seed : integer, default 1
            Seed of the random phases, frequencies and directions. Allowed: >= 0.
        lost_variance : number, optional
            Largest part of the variance that may lie outside the frequencies of the database
            and is left out; 0.02 by default for a record, 0.1 for a spectrum without
            frequency_range. Allowed: 0 to 1.
        frequency_range : list of numbers, rad/s, optional
            Lowest and highest frequency; default: all but 0.1 % of the energy below and 0.5 %
            above, as far as the database reaches. Allowed: > 0.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def measured(
        self,
        name: str,
        *,
        heading_deg: float = ...,
        file: str = ...,
        time: _Numbers = ...,
        elevation: _Numbers = ...,
        point: _Numbers = ...,
        start: float = ...,
        taper: float = ...,
        lost_variance: float = ...,
        frequency_range: _Numbers = ...,
    ) -> str:
        """Add `[[wave]]` with the type "measured".

        Elevation over time at a point: the harmonics of the record.

        Parameters
        ----------
        name : text
            Name of the wave system.
        heading_deg : number, deg, default 0
            Mean direction of travel; 0 = +x, 90 = +y. Allowed: -360 to 360.
        file : text, optional
            Measured elevation: text with commas, named columns time [s] and elevation [m];
            relative to the case file.
        time : list of numbers, s, optional
            Times of a measured elevation, at equal steps; without a file.
        elevation : list of numbers, m, optional
            Measured elevation at these times.
        point : list of numbers, m, optional
            Where it was measured, [x, y]; the origin by default.
        start : number, s, default 0
            Time since the first sample of the record at which t = 0. Allowed: >= 0.
        taper : number, s, default 30
            Time over which a record fades at both ends, because the waves before and after it
            are unknown; 30 s by default. Allowed: >= 0.
        lost_variance : number, optional
            Largest part of the variance that may lie outside the frequencies of the database
            and is left out; 0.02 by default for a record, 0.1 for a spectrum without
            frequency_range. Allowed: 0 to 1.
        frequency_range : list of numbers, rad/s, optional
            Lowest and highest frequency; default: all but 0.1 % of the energy below and 0.5 %
            above, as far as the database reaches. Allowed: > 0.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """

class JointTypes(TypedList):
    """A joint that carries body B on body A, or on the ground."""

    def spherical(
        self,
        name: str,
        *,
        body_a: str,
        body_b: str,
        point: _Numbers,
    ) -> str:
        """Add `[[joint]]` with the type "spherical".

        Ball joint: the bodies share one point and turn about it freely.

        Parameters
        ----------
        name : text
            Name of the joint.
        body_a : text
            Body that carries the first marker, or ground.
        body_b : text
            Body that carries the second marker, or ground.
        point : 3 numbers, m
            Where the joint is in the reference pose, world axes.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def revolute(
        self,
        name: str,
        *,
        body_a: str,
        body_b: str,
        point: _Numbers,
        axis: _Numbers,
        axis_x: _Numbers = ...,
        initial: RevoluteInitial = ...,
    ) -> str:
        """Add `[[joint]]` with the type "revolute".

        Hinge: body B turns about the axis.

        Parameters
        ----------
        name : text
            Name of the joint.
        body_a : text
            Body that carries the first marker, or ground.
        body_b : text
            Body that carries the second marker, or ground.
        point : 3 numbers, m
            Where the joint is in the reference pose, world axes.
        axis : 3 numbers
            Direction of the axis in the reference pose, world axes: z of both markers.
        axis_x : 3 numbers, optional
            Direction across the axis that is x of both markers (made perpendicular to the
            axis).
        initial : dict, optional
            Start of the joint in its own coordinate; body B, and what hangs on it, is moved.
            Keys: angle_deg [deg], angle_rate [rad/s].

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def prismatic(
        self,
        name: str,
        *,
        body_a: str,
        body_b: str,
        point: _Numbers,
        axis: _Numbers,
        axis_x: _Numbers = ...,
        initial: PrismaticInitial = ...,
    ) -> str:
        """Add `[[joint]]` with the type "prismatic".

        Slider: body B moves along the axis and does not turn.

        Parameters
        ----------
        name : text
            Name of the joint.
        body_a : text
            Body that carries the first marker, or ground.
        body_b : text
            Body that carries the second marker, or ground.
        point : 3 numbers, m
            Where the joint is in the reference pose, world axes.
        axis : 3 numbers
            Direction of the axis in the reference pose, world axes: z of both markers.
        axis_x : 3 numbers, optional
            Direction across the axis that is x of both markers (made perpendicular to the
            axis).
        initial : dict, optional
            Start of the joint in its own coordinate; body B, and what hangs on it, is moved.
            Keys: displacement [m], displacement_rate [m/s].

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def fixed(
        self,
        name: str,
        *,
        body_a: str,
        body_b: str,
        point: _Numbers,
        axis: _Numbers = ...,
        axis_x: _Numbers = ...,
    ) -> str:
        """Add `[[joint]]` with the type "fixed".

        Weld: the bodies move as one.

        Parameters
        ----------
        name : text
            Name of the joint.
        body_a : text
            Body that carries the first marker, or ground.
        body_b : text
            Body that carries the second marker, or ground.
        point : 3 numbers, m
            Where the joint is in the reference pose, world axes.
        axis : 3 numbers, optional
            Direction of the axis in the reference pose, world axes: z of both markers.
        axis_x : 3 numbers, optional
            Direction across the axis that is x of both markers (made perpendicular to the
            axis).

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def universal(
        self,
        name: str,
        *,
        body_a: str,
        body_b: str,
        point: _Numbers,
        axis: _Numbers,
        axis_x: _Numbers = ...,
        initial: UniversalInitial = ...,
    ) -> str:
        """Add `[[joint]]` with the type "universal".

        Cardan joint: body B turns about two crossed axes, x of body A and y of body B.

        Parameters
        ----------
        name : text
            Name of the joint.
        body_a : text
            Body that carries the first marker, or ground.
        body_b : text
            Body that carries the second marker, or ground.
        point : 3 numbers, m
            Where the joint is in the reference pose, world axes.
        axis : 3 numbers
            Direction of the axis in the reference pose, world axes: z of both markers.
        axis_x : 3 numbers, optional
            Direction across the axis that is x of both markers (made perpendicular to the
            axis).
        initial : dict, optional
            Start of the joint in its own coordinate; body B, and what hangs on it, is moved.
            Keys: angle_deg [deg], angle_rate [rad/s].

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def cylindrical(
        self,
        name: str,
        *,
        body_a: str,
        body_b: str,
        point: _Numbers,
        axis: _Numbers,
        axis_x: _Numbers = ...,
        initial: CylindricalInitial = ...,
    ) -> str:
        """Add `[[joint]]` with the type "cylindrical".

        Body B turns about the axis and moves along it.

        Parameters
        ----------
        name : text
            Name of the joint.
        body_a : text
            Body that carries the first marker, or ground.
        body_b : text
            Body that carries the second marker, or ground.
        point : 3 numbers, m
            Where the joint is in the reference pose, world axes.
        axis : 3 numbers
            Direction of the axis in the reference pose, world axes: z of both markers.
        axis_x : 3 numbers, optional
            Direction across the axis that is x of both markers (made perpendicular to the
            axis).
        initial : dict, optional
            Start of the joint in its own coordinate; body B, and what hangs on it, is moved.
            Keys: angle_deg [deg], angle_rate [rad/s], displacement [m], displacement_rate
            [m/s].

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def planar(
        self,
        name: str,
        *,
        body_a: str,
        body_b: str,
        point: _Numbers,
        axis: _Numbers,
        axis_x: _Numbers = ...,
        initial: PlanarInitial = ...,
    ) -> str:
        """Add `[[joint]]` with the type "planar".

        Body B moves in the plane across the axis and turns in it.

        Parameters
        ----------
        name : text
            Name of the joint.
        body_a : text
            Body that carries the first marker, or ground.
        body_b : text
            Body that carries the second marker, or ground.
        point : 3 numbers, m
            Where the joint is in the reference pose, world axes.
        axis : 3 numbers
            Direction of the axis in the reference pose, world axes: z of both markers.
        axis_x : 3 numbers, optional
            Direction across the axis that is x of both markers (made perpendicular to the
            axis).
        initial : dict, optional
            Start of the joint in its own coordinate; body B, and what hangs on it, is moved.
            Keys: angle_deg [deg], angle_rate [rad/s], displacement [m], displacement_rate
            [m/s].

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def sliding(
        self,
        name: str,
        *,
        body_a: str,
        body_b: str,
        point: _Numbers,
        axis: _Numbers,
        axis_x: _Numbers = ...,
        initial: SlidingInitial = ...,
    ) -> str:
        """Add `[[joint]]` with the type "sliding".

        A point of body B moves along the axis, which body A carries; all rotations are free.

        Parameters
        ----------
        name : text
            Name of the joint.
        body_a : text
            Body that carries the first marker, or ground.
        body_b : text
            Body that carries the second marker, or ground.
        point : 3 numbers, m
            Where the joint is in the reference pose, world axes.
        axis : 3 numbers
            Direction of the axis in the reference pose, world axes: z of both markers.
        axis_x : 3 numbers, optional
            Direction across the axis that is x of both markers (made perpendicular to the
            axis).
        initial : dict, optional
            Start of the joint in its own coordinate; body B, and what hangs on it, is moved.
            Keys: displacement [m], displacement_rate [m/s].

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def screw(
        self,
        name: str,
        *,
        body_a: str,
        body_b: str,
        point: _Numbers,
        axis: _Numbers,
        pitch: float,
        axis_x: _Numbers = ...,
        initial: ScrewInitial = ...,
    ) -> str:
        """Add `[[joint]]` with the type "screw".

        Body B turns about the axis and advances along it by `pitch` for each turn.

        Parameters
        ----------
        name : text
            Name of the joint.
        body_a : text
            Body that carries the first marker, or ground.
        body_b : text
            Body that carries the second marker, or ground.
        point : 3 numbers, m
            Where the joint is in the reference pose, world axes.
        axis : 3 numbers
            Direction of the axis in the reference pose, world axes: z of both markers.
        axis_x : 3 numbers, optional
            Direction across the axis that is x of both markers (made perpendicular to the
            axis).
        pitch : number, m per turn
            Advance of body B along the axis for one turn about it, not zero; screw joint only.
        initial : dict, optional
            Start of the joint in its own coordinate; body B, and what hangs on it, is moved.
            Keys: angle_deg [deg], angle_rate [rad/s], displacement [m], displacement_rate
            [m/s].

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def distance(
        self,
        name: str,
        *,
        body_a: str,
        body_b: str,
        point: _Numbers,
        point_b: _Numbers,
        length: float = ...,
        one_sided: bool = ...,
        restitution: float = ...,
        contact_time: float = ...,
    ) -> str:
        """Add `[[joint]]` with the type "distance".

        Massless rod between two points; `one_sided`: an inextensible rope.

        Parameters
        ----------
        name : text
            Name of the joint.
        body_a : text
            Body that carries the first marker, or ground.
        body_b : text
            Body that carries the second marker, or ground.
        point : 3 numbers, m
            Where the joint is in the reference pose, world axes.
        point_b : 3 numbers, m
            Point on body B in the reference pose, world axes; distance joint only.
        length : number, m, optional
            Distance that is kept; default: that of point and point_b. Distance joint only.
            Allowed: > 0.
        one_sided : true or false, default false
            The points may come nearer than `length`, as on a taut or slack rope; distance joint
            only.
        restitution : number, optional
            Rate of the distance after a one-sided joint becomes taut over the rate before; 0,
            the default: no rebound. Allowed: 0 to 1.
        contact_time : number, s, optional
            How long an impact of a one-sided joint is taken to last, for its peak force; see
            that of a stop. Allowed: > 0.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def telescope(
        self,
        name: str,
        *,
        body_a: str,
        body_b: str,
        point: _Numbers,
        point_b: _Numbers,
        initial: TelescopeInitial = ...,
    ) -> str:
        """Add `[[joint]]` with the type "telescope".

        Two points whose distance is free: holds nothing, but forces act along the distance.

        Parameters
        ----------
        name : text
            Name of the joint.
        body_a : text
            Body that carries the first marker, or ground.
        body_b : text
            Body that carries the second marker, or ground.
        point : 3 numbers, m
            Where the joint is in the reference pose, world axes.
        point_b : 3 numbers, m
            Point on body B in the reference pose, world axes; distance joint only.
        initial : dict, optional
            Start of the joint in its own coordinate; body B, and what hangs on it, is moved.
            Keys: displacement [m], displacement_rate [m/s].

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def path(
        self,
        name: str,
        *,
        body_a: str,
        body_b: str,
        point: _Numbers,
        path: _Rows,
        initial: PathInitial = ...,
    ) -> str:
        """Add `[[joint]]` with the type "path".

        A point of body B moves along a curve that body A carries.

        Parameters
        ----------
        name : text
            Name of the joint.
        body_a : text
            Body that carries the first marker, or ground.
        body_b : text
            Body that carries the second marker, or ground.
        point : 3 numbers, m
            Where the joint is in the reference pose, world axes.
        path : list of points, m
            Points of the curve that body A carries, in the reference pose, world axes. A
            natural cubic spline joins them and continues straight beyond its ends; path joint
            only.
        initial : dict, optional
            Start of the joint in its own coordinate; body B, and what hangs on it, is moved.
            Keys: displacement [m], displacement_rate [m/s].

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """

class ConstraintTypes(TypedList):
    """A condition on coordinates of joints or bodies."""

    def coordinate(
        self,
        name: str,
        *,
        joint: str = ...,
        body: str = ...,
        coordinate: str = ...,
        level: _CoordinateLevel = ...,
        drive: CoordinateDrive = ...,
    ) -> str:
        """Add `[[constraint]]` with the type "coordinate".

        One coordinate of a joint or a body follows a function of time.

        Parameters
        ----------
        name : text
            Name of the constraint in the results.
        joint : text, optional
            Joint whose coordinate is meant.
        body : text, optional
            Body whose coordinate is meant (relative to its reference pose).
        coordinate : text, optional
            Which one: surge ... yaw of a body; angle, displacement (angle_2, ...) of a joint.
            By default the first of the joint.
        level : text, default "position"
            What follows the function: the coordinate or its rate. Allowed: position, velocity.
        drive : dict, optional
            Function of time: constant + rate t + ramp(t) amplitude sin(2 pi t / period + phase)
            + table + function; ramp(t) = (1 - cos(pi t / ramp)) / 2, then 1. Keys: constant [m
            or rad], rate [m/s or rad/s], amplitude [m or rad], period [s], phase_deg [deg],
            ramp [s], time [s], values [m or rad], python.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def coupler(
        self,
        name: str,
        *,
        joint: str,
        joint_b: str,
        coordinate: str = ...,
        coordinate_b: str = ...,
        ratio: float = ...,
    ) -> str:
        """Add `[[constraint]]` with the type "coupler".

        Two joint coordinates keep a ratio, as gears, racks and belts do: s_b - s_b(0) = ratio
        (s - s(0)).

        Parameters
        ----------
        name : text
            Name of the constraint in the results.
        joint : text
            Joint whose coordinate is meant.
        coordinate : text, optional
            Which one: surge ... yaw of a body; angle, displacement (angle_2, ...) of a joint.
            By default the first of the joint.
        joint_b : text
            Second joint of a coupler.
        coordinate_b : text, optional
            Its coordinate; by default the first.
        ratio : number, - or m/rad, default 1
            Motion of the second joint per motion of the first.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def stop(
        self,
        name: str,
        *,
        joint: str,
        coordinate: str = ...,
        lower: float = ...,
        upper: float = ...,
        lower_deg: float = ...,
        upper_deg: float = ...,
        restitution: float = ...,
        contact_time: float = ...,
    ) -> str:
        """Add `[[constraint]]` with the type "stop".

        A joint coordinate stays within bounds, with impacts.

        Parameters
        ----------
        name : text
            Name of the constraint in the results.
        joint : text
            Joint whose coordinate is meant.
        coordinate : text, optional
            Which one: surge ... yaw of a body; angle, displacement (angle_2, ...) of a joint.
            By default the first of the joint.
        lower : number, m, optional
            Least displacement that a stop allows.
        upper : number, m, optional
            Largest displacement that a stop allows.
        lower_deg : number, deg, optional
            Least angle that a stop allows.
        upper_deg : number, deg, optional
            Largest angle that a stop allows.
        restitution : number, optional
            Rate after an impact over the rate before; 0, the default: no rebound. Allowed: 0 to
            1.
        contact_time : number, s, optional
            How long an impact is taken to last: half a sine of this length has the impulse J at
            a peak force of pi J / (2 contact_time), which the results then list. The motion
            does not know of it. Allowed: > 0.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """

class ForceTypes(TypedList):
    """What loads the bodies beside weight, water and joints."""

    def mooring_matrix(
        self,
        name: str,
        *,
        body: str,
        stiffness: _Numbers | _Rows,
        damping: _Numbers | _Rows = ...,
        pretension: _Numbers = ...,
    ) -> str:
        """Add `[[force]]` with the type "mooring_matrix".

        Mooring as a linear matrix about the reference pose of a body: F = F0 - K xi - C v.

        Parameters
        ----------
        name : text
            Name of this force in the results.
        body : text
            Body that is moored.
        stiffness : 6 numbers or 6 x 6, N/m, N, N m
            K: six numbers (diagonal: surge, sway, heave, roll, pitch, yaw) or a 6x6 matrix.
        damping : 6 numbers or 6 x 6, N s/m, N s, N m s, default [0, 0, 0, 0, 0, 0]
            C: six numbers (diagonal) or a 6x6 matrix.
        pretension : 6 numbers, N, N m, default [0, 0, 0, 0, 0, 0]
            F0: force and moment in the reference pose.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def pto_linear(
        self,
        name: str,
        *,
        joint: str,
        coordinate: str = ...,
        damping: float = ...,
        stiffness: float = ...,
        neutral: float = ...,
        delay: float = ...,
    ) -> str:
        """Add `[[force]]` with the type "pto_linear".

        Linear power take-off along a joint: f = -k (s - s0) - c s'.

        Parameters
        ----------
        name : text
            Name of this force in the results.
        joint : text
            Joint along which it acts.
        coordinate : text, optional
            Which coordinate of the joint: displacement, angle, angle_2, ...; default: its only
            one.
        damping : number, N s/m or N m s/rad, default 0
            Damping c. Allowed: >= 0.
        stiffness : number, N/m or N m/rad, default 0
            Stiffness k; negative: it pushes away from `neutral`, as reactive control does.
        neutral : number, m or rad, default 0
            Joint coordinate s0 at which the spring is slack.
        delay : number, s, default 0
            Pure delay tau of damper and spring: they act on the coordinate as it was tau ago.
            Allowed: >= 0.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def spring_damper(
        self,
        name: str,
        *,
        body_a: str,
        body_b: str,
        point_a: _Numbers,
        point_b: _Numbers,
        stiffness: float = ...,
        damping: float = ...,
        force: float = ...,
        length: float = ...,
        hardening: _Numbers = ...,
        curve_at: _Numbers = ...,
        curve_force: _Numbers = ...,
    ) -> str:
        """Add `[[force]]` with the type "spring_damper".

        Spring and damper between points of two bodies: f = -k (s - s0) - c s' + f0, s their
        distance.

        Parameters
        ----------
        name : text
            Name of this force in the results.
        body_a : text
            First body, or ground.
        body_b : text
            Second body, or ground.
        point_a : 3 numbers, m
            Point of the first body in the reference pose, world axes.
        point_b : 3 numbers, m
            Point of the second body in the reference pose, world axes.
        stiffness : number, N/m, default 0
            Stiffness k; negative: it pushes away from `length`.
        damping : number, N s/m, default 0
            Damping c. Allowed: >= 0.
        force : number, N, default 0
            Constant part f0, positive apart.
        length : number, m, optional
            Length s0 at which the spring is slack; default: distance of the points in the
            reference pose. Allowed: >= 0.
        hardening : list of numbers, N/m2, N/m3, ..., optional
            k2, k3, ... of the powers of s - s0.
        curve_at : list of numbers, m, optional
            Places s - s0, ascending, of `curve_force`.
        curve_force : list of numbers, N, optional
            Forces F there, together for > 0.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def constant_load(
        self,
        name: str,
        *,
        body: str,
        force: _Numbers = ...,
        moment: _Numbers = ...,
    ) -> str:
        """Add `[[force]]` with the type "constant_load".

        Constant force at the centre of gravity and constant moment, world axes.

        Parameters
        ----------
        name : text
            Name of this force in the results.
        body : text
            Body that is loaded.
        force : 3 numbers, N, default [0, 0, 0]
            Force at the centre of gravity, world axes.
        moment : 3 numbers, N m, default [0, 0, 0]
            Moment, world axes.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def viscous_damping(
        self,
        name: str,
        *,
        body: str,
        linear: _Numbers | _Rows = ...,
        quadratic: _Numbers | _Rows = ...,
    ) -> str:
        """Add `[[force]]` with the type "viscous_damping".

        Damping of one body about its centre of gravity, linear and quadratic: W = -C v - Q (v
        |v|).

        Parameters
        ----------
        name : text
            Name of this force in the results.
        body : text
            Body that is damped.
        linear : 6 numbers or 6 x 6, N s/m, N s, N m s, default [0, 0, 0, 0, 0, 0]
            C: six numbers (diagonal: surge, sway, heave, roll, pitch, yaw) or a 6x6 matrix.
        quadratic : 6 numbers or 6 x 6, N s2/m2, N s2, N m s2, default [0, 0, 0, 0, 0, 0]
            Q: six numbers (diagonal) or a 6x6 matrix.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def dry_friction(
        self,
        name: str,
        *,
        joint: str,
        coordinate: str = ...,
        static: float = ...,
        kinetic: float = ...,
        static_coefficient: float = ...,
        kinetic_coefficient: float = ...,
        preload: float = ...,
        length: float = ...,
        radius: float = ...,
        radius_axial: float = ...,
        small_force: float = ...,
    ) -> str:
        """Add `[[force]]` with the type "dry_friction".

        Coulomb friction along a joint, with located sticking and slipping.

        Parameters
        ----------
        name : text
            Name of this force in the results.
        joint : text
            Joint along which it acts.
        coordinate : text, optional
            Which coordinate of the joint: displacement, angle, angle_2, ...; default: its only
            one.
        static : number, N or N m, optional
            Largest load F_s of sticking, without the viscous part; or `static_coefficient`.
            Allowed: > 0.
        kinetic : number, N or N m, optional
            Load F_c of slip, without the viscous part; default: as `static`. Allowed: >= 0.
        static_coefficient : number, optional
            In place of `static`: F_s over what the reaction of the joint presses with. Allowed:
            > 0.
        kinetic_coefficient : number, optional
            In place of `kinetic`: F_c over the same; default: as `static_coefficient`. Allowed:
            >= 0.
        preload : number, N, default 0
            Force by which the bearing is pressed beside the reaction. Allowed: >= 0.
        length : number, m, optional
            Distance along the axis of the two bearings, about the joint's point on body B,
            which share the moment across the axis. Allowed: > 0.
        radius : number, m, optional
            Of an angle: at which the bearing rubs. Of a displacement: at which it holds the
            moment about the axis. Allowed: > 0.
        radius_axial : number, m, optional
            Of an angle: at which the thrust along the axis rubs; 0: it does not. Allowed: >= 0.
        small_force : number, N, optional
            Smallest size of the force on a bearing, so that friction stays smooth at zero;
            default: 1e-5 of the weight of the lighter body that moves. Allowed: > 0.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def pto_hydraulic(
        self,
        name: str,
        *,
        joint: str,
        area: float,
        motor_conductance: float,
        pressure_high: float,
        pressure_low: float,
        volume_high: float,
        volume_low: float,
        valve_rate: float,
        coordinate: str = ...,
        polytropic: float = ...,
    ) -> str:
        """Add `[[force]]` with the type "pto_hydraulic".

        Hydraulic power take-off along a joint: cylinder, check valves, two gas accumulators,
        motor.

        Parameters
        ----------
        name : text
            Name of this force in the results.
        joint : text
            Joint along which it acts.
        coordinate : text, optional
            Which coordinate of the joint: displacement, angle, angle_2, ...; default: its only
            one.
        area : number, m2 or m3/rad
            Area A of the piston; on a rotation times its lever. Allowed: > 0.
        motor_conductance : number, m3/(s Pa)
            Flow G through the motor for each pascal between the accumulators. Allowed: >= 0.
        pressure_high : number, Pa
            Pressure of the high accumulator at the start, absolute. Allowed: > 0.
        pressure_low : number, Pa
            Pressure of the low accumulator at the start, absolute. Allowed: > 0.
        volume_high : number, m3
            Gas in the high accumulator at the start. Allowed: > 0.
        volume_low : number, m3
            Gas in the low accumulator at the start. Allowed: > 0.
        polytropic : number, default 1.4
            Exponent n of the gas: 1 isothermal, 1.4 adiabatic (nitrogen). Allowed: 1 to 2.
        valve_rate : number, m/s or rad/s
            Rate s'_v about which the check valves change over. Allowed: > 0.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def friction_lugre(
        self,
        name: str,
        *,
        joint: str,
        stribeck_rate: float,
        bristle_stiffness: float,
        bristle_damping: float,
        coordinate: str = ...,
        static: float = ...,
        kinetic: float = ...,
        static_coefficient: float = ...,
        kinetic_coefficient: float = ...,
        preload: float = ...,
        length: float = ...,
        radius: float = ...,
        radius_axial: float = ...,
        small_force: float = ...,
        viscous: float = ...,
    ) -> str:
        """Add `[[force]]` with the type "friction_lugre".

        Bristle friction (LuGre) along a joint: sticks and slips smoothly, by a state of its
        own.

        Parameters
        ----------
        name : text
            Name of this force in the results.
        joint : text
            Joint along which it acts.
        coordinate : text, optional
            Which coordinate of the joint: displacement, angle, angle_2, ...; default: its only
            one.
        static : number, N or N m, optional
            Largest load F_s of sticking, without the viscous part; or `static_coefficient`.
            Allowed: > 0.
        kinetic : number, N or N m, optional
            Load F_c of slip, without the viscous part; default: as `static`. Allowed: > 0.
        static_coefficient : number, optional
            In place of `static`: F_s over what the reaction of the joint presses with. Allowed:
            > 0.
        kinetic_coefficient : number, optional
            In place of `kinetic`: F_c over the same; default: as `static_coefficient`. Allowed:
            > 0.
        preload : number, N, default 0
            Force by which the bearing is pressed beside the reaction. Allowed: >= 0.
        length : number, m, optional
            Distance along the axis of the two bearings, about the joint's point on body B,
            which share the moment across the axis. Allowed: > 0.
        radius : number, m, optional
            Of an angle: at which the bearing rubs. Of a displacement: at which it holds the
            moment about the axis. Allowed: > 0.
        radius_axial : number, m, optional
            Of an angle: at which the thrust along the axis rubs; 0: it does not. Allowed: >= 0.
        small_force : number, N, optional
            Smallest size of the force on a bearing, so that friction stays smooth at zero;
            default: 1e-5 of the weight of the lighter body that moves. Allowed: > 0.
        stribeck_rate : number, m/s or rad/s
            Rate s'_s over which the load falls from F_s to F_c. Allowed: > 0.
        bristle_stiffness : number, N/m or N m/rad
            Stiffness sigma_0. Allowed: > 0.
        bristle_damping : number, N s/m or N m s/rad
            Damping sigma_1 of the bristles: 2 sqrt(sigma_0 m) lets a mass (or inertia) m stick
            without swinging. Allowed: >= 0.
        viscous : number, N s/m or N m s/rad, default 0
            Viscous damping sigma_2. Allowed: >= 0.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def bushing(
        self,
        name: str,
        *,
        body_a: str,
        body_b: str,
        point: _Numbers,
        stiffness: _Numbers | _Rows,
        axis: _Numbers = ...,
        axis_x: _Numbers = ...,
        damping: _Numbers | _Rows = ...,
        pretension: _Numbers = ...,
    ) -> str:
        """Add `[[force]]` with the type "bushing".

        Elastic joint: stiffness and damping of all six relative motions of two bodies at a
        point.

        Parameters
        ----------
        name : text
            Name of this force in the results.
        body_a : text
            First body, or ground: it carries the axes.
        body_b : text
            Second body, or ground: the load acts on it.
        point : 3 numbers, m
            Where the bushing is in the reference pose, world axes.
        axis : 3 numbers, optional
            Its z axis in the reference pose; default: that of the world.
        axis_x : 3 numbers, optional
            Its x axis in the reference pose, across `axis`.
        stiffness : 6 numbers or 6 x 6, N/m, N, N m/rad
            K: six numbers (diagonal: x, y, z, about x, y, z) or a 6x6 matrix.
        damping : 6 numbers or 6 x 6, N s/m, N s, N m s/rad, default [0, 0, 0, 0, 0, 0]
            C: six numbers (diagonal) or a 6x6 matrix.
        pretension : 6 numbers, N, N m, default [0, 0, 0, 0, 0, 0]
            W0: force and moment in the reference pose.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def python_load(
        self,
        name: str,
        *,
        joint: str,
        coordinate: str = ...,
    ) -> str:
        """Add `[[force]]` with the type "python_load".

        Load along a joint by a Python function f(t, s, s').

        Parameters
        ----------
        name : text
            Name of this force in the results; its function f(t, s, s') is given to
            hydrodae.run(..., forces={name: function}).
        joint : text
            Joint along which it acts.
        coordinate : text, optional
            Which coordinate of the joint: displacement, angle, angle_2, ...; default: its only
            one.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def python_wrench(
        self,
        name: str,
        *,
        body: str,
    ) -> str:
        """Add `[[force]]` with the type "python_wrench".

        Force and moment on a body by a Python function f(t, displacement, twist).

        Parameters
        ----------
        name : text
            Name of this force in the results; its function f(t, displacement, twist) is given
            to hydrodae.run(..., forces={name: function}).
        body : text
            Body that is loaded.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def pto_general(
        self,
        name: str,
        *,
        joint: str,
        coordinate: str = ...,
        stiffness: float = ...,
        neutral: float = ...,
        damping: float = ...,
        exponent: float = ...,
        constant: float = ...,
        reversal_rate: float = ...,
        spring_at: _Numbers = ...,
        spring_load: _Numbers = ...,
        damper_at: _Numbers = ...,
        damper_load: _Numbers = ...,
        load_limit: float = ...,
        power_limit: float = ...,
        efficiency: float = ...,
        motor_efficiency: float = ...,
    ) -> str:
        """Add `[[force]]` with the type "pto_general".

        Power take-off along a joint: springs and dampers linear, by a power or by measured
        points, constant load, limits of load and power, efficiencies.

        Parameters
        ----------
        name : text
            Name of this force in the results.
        joint : text
            Joint along which it acts.
        coordinate : text, optional
            Which coordinate of the joint: displacement, angle, angle_2, ...; default: its only
            one.
        stiffness : number, N/m or N m/rad, default 0
            Stiffness k; negative: it pushes away from `neutral`.
        neutral : number, m or rad, default 0
            Joint coordinate s0 at which this spring is slack.
        damping : number, N (s/m)^n or N m (s/rad)^n, default 0
            Damping c. Allowed: >= 0.
        exponent : number, default 1
            Exponent n of the damping: 1 linear, 2 quadratic. Allowed: 1 to 10.
        constant : number, N or N m, default 0
            Load F_0 against the motion, whatever its rate. Allowed: >= 0.
        reversal_rate : number, m/s or rad/s, optional
            Rate s'_0 over which `constant` changes its sign. Allowed: > 0.
        spring_at : list of numbers, m or rad, optional
            Joint coordinates, ascending, of `spring_load`.
        spring_load : list of numbers, N or N m, optional
            Loads F_k of a spring there, back for > 0.
        damper_at : list of numbers, m/s or rad/s, optional
            Rates, ascending, of `damper_load`.
        damper_load : list of numbers, N or N m, optional
            Loads F_c of a damper there, back for > 0.
        load_limit : number, N or N m, optional
            Largest load F_max of all together. Allowed: > 0.
        power_limit : number, W, optional
            Largest power P_max, either way. Allowed: > 0.
        efficiency : number, default 1
            eta of absorbed power. Allowed: 0 to 1.
        motor_efficiency : number, default 1
            eta_m of power given to the device. Allowed: > 0, <= 1.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def pto_rotary(
        self,
        name: str,
        *,
        body_a: str,
        body_b: str,
        axis: _Numbers = ...,
        axis_x: _Numbers = ...,
        stiffness: _Numbers = ...,
        damping: _Numbers = ...,
    ) -> str:
        """Add `[[force]]` with the type "pto_rotary".

        Linear power take-off on relative roll, pitch and yaw of two bodies: m = -K theta - C
        omega.

        Parameters
        ----------
        name : text
            Name of this force in the results.
        body_a : text
            First body, or ground: it carries the axes.
        body_b : text
            Second body, or ground: the moment acts on it.
        axis : 3 numbers, optional
            Its z axis in the reference pose; default: that of the world.
        axis_x : 3 numbers, optional
            Its x axis in the reference pose, across `axis`.
        stiffness : 3 numbers, N m/rad, default [0, 0, 0]
            K about x, y and z: roll, pitch, yaw. Allowed: >= 0.
        damping : 3 numbers, N m s/rad, default [0, 0, 0]
            C about x, y and z. Allowed: >= 0.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def friction_stribeck(
        self,
        name: str,
        *,
        joint: str,
        creep_rate: float,
        coordinate: str = ...,
        static: float = ...,
        kinetic: float = ...,
        static_coefficient: float = ...,
        kinetic_coefficient: float = ...,
        preload: float = ...,
        length: float = ...,
        radius: float = ...,
        radius_axial: float = ...,
        small_force: float = ...,
        stribeck_rate: float = ...,
        viscous: float = ...,
    ) -> str:
        """Add `[[force]]` with the type "friction_stribeck".

        Smooth friction along a joint (Coulomb, Stribeck and viscous); creeps where it should
        stick.

        Parameters
        ----------
        name : text
            Name of this force in the results.
        joint : text
            Joint along which it acts.
        coordinate : text, optional
            Which coordinate of the joint: displacement, angle, angle_2, ...; default: its only
            one.
        static : number, N or N m, optional
            Largest load F_s of sticking, without the viscous part; or `static_coefficient`.
            Allowed: > 0.
        kinetic : number, N or N m, optional
            Load F_c of slip, without the viscous part; default: as `static`. Allowed: >= 0.
        static_coefficient : number, optional
            In place of `static`: F_s over what the reaction of the joint presses with. Allowed:
            > 0.
        kinetic_coefficient : number, optional
            In place of `kinetic`: F_c over the same; default: as `static_coefficient`. Allowed:
            >= 0.
        preload : number, N, default 0
            Force by which the bearing is pressed beside the reaction. Allowed: >= 0.
        length : number, m, optional
            Distance along the axis of the two bearings, about the joint's point on body B,
            which share the moment across the axis. Allowed: > 0.
        radius : number, m, optional
            Of an angle: at which the bearing rubs. Of a displacement: at which it holds the
            moment about the axis. Allowed: > 0.
        radius_axial : number, m, optional
            Of an angle: at which the thrust along the axis rubs; 0: it does not. Allowed: >= 0.
        small_force : number, N, optional
            Smallest size of the force on a bearing, so that friction stays smooth at zero;
            default: 1e-5 of the weight of the lighter body that moves. Allowed: > 0.
        creep_rate : number, m/s or rad/s
            Rate s'_0 below which it is viscous: some thousandth of the rates at work. Allowed:
            > 0.
        stribeck_rate : number, m/s or rad/s, optional
            Rate s'_s over which the load falls from F_s to F_c; default: ten times
            `creep_rate`. Allowed: > 0.
        viscous : number, N s/m or N m s/rad, default 0
            Viscous damping sigma. Allowed: >= 0.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def end_stop(
        self,
        name: str,
        *,
        joint: str,
        stiffness: float,
        coordinate: str = ...,
        lower: float = ...,
        upper: float = ...,
        lower_deg: float = ...,
        upper_deg: float = ...,
        exponent: float = ...,
        damping: float = ...,
        viscous: float = ...,
        width: float = ...,
    ) -> str:
        """Add `[[force]]` with the type "end_stop".

        Compliant end stops along a joint: a hardening spring with Hunt-Crossley damping.

        Parameters
        ----------
        name : text
            Name of this force in the results.
        joint : text
            Joint along which it acts.
        coordinate : text, optional
            Which coordinate of the joint: displacement, angle, angle_2, ...; default: its only
            one.
        lower : number, m, optional
            Coordinate below which the stop pushes back.
        upper : number, m, optional
            Coordinate above which it does.
        lower_deg : number, deg, optional
            The same of a joint that turns.
        upper_deg : number, deg, optional
            The same of a joint that turns.
        stiffness : number, N/m^n or N m/rad^n
            Stiffness k. Allowed: > 0.
        exponent : number, default 1.5
            Exponent n: 1 a spring, 1.5 round bodies that touch. Allowed: 1 to 10.
        damping : number, s/m or s/rad, default 0
            Damping d: at a low speed v the part 1 - 2 d v / 3 of it is given back. Allowed: >=
            0.
        viscous : number, N s/m or N m s/rad, default 0
            Damping c from the first touch on, linear. Allowed: >= 0.
        width : number, m or rad, default 0
            Depth over which the stop gets hard. Allowed: >= 0.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def rope(
        self,
        name: str,
        *,
        bodies: str | Sequence[str],
        points: _Rows,
        stiffness: float,
        damping: float = ...,
        length: float = ...,
        pretension: float = ...,
        winch_time: _Numbers = ...,
        winch_length: _Numbers = ...,
        radii: _Numbers = ...,
        axes: _Rows = ...,
        friction: _Numbers = ...,
        breaking_load: float = ...,
        breaks: bool = ...,
    ) -> str:
        """Add `[[force]]` with the type "rope".

        Elastic rope without mass over points and sheaves of bodies, which pulls only; with a
        winch if wanted.

        Parameters
        ----------
        name : text
            Name of this force in the results.
        bodies : text or list of texts
            Bodies, or ground, that the points belong to, one each.
        points : list of points, m
            Points along the rope in the reference pose, world axes; it runs freely over those
            between the ends.
        stiffness : number, N
            Axial stiffness EA. Allowed: > 0.
        damping : number, N s, default 0
            Axial damping D. Allowed: >= 0.
        length : number, m, optional
            Unstretched length L0; default: the rope is just straight in the reference pose.
            Allowed: > 0.
        pretension : number, N, optional
            Tension in the reference pose, in place of `length`. Allowed: > 0.
        winch_time : list of numbers, s, optional
            Times, ascending, of `winch_length`.
        winch_length : list of numbers, m, optional
            Unstretched lengths at these times. Allowed: > 0.
        radii : list of numbers, m, optional
            Radii of the sheaves, one for each point, which is the centre; 0: a point, as the
            ends. Allowed: >= 0.
        axes : list of points, optional
            Axes of the sheaves, one for each point (any value for a point without a sheave),
            world axes: from first to last point the rope runs round them by the right-hand
            rule.
        friction : list of numbers, optional
            Coefficients of friction of the points and sheaves, one for each point (0 at the
            ends), or one for all between the ends; a sheave with friction does not turn on its
            body. Allowed: >= 0.
        breaking_load : number, N, optional
            Tension that it bears; the summary reports where it is exceeded. Allowed: > 0.
        breaks : true or false, default false
            Whether it parts for good where its tension reaches `breaking_load`.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def catenary(
        self,
        name: str,
        *,
        body_b: str,
        point_a: _Numbers,
        point_b: _Numbers,
        length: _Numbers,
        weight: _Numbers,
        stiffness: _Numbers,
        body_a: str = ...,
        loads: _Numbers = ...,
        dry_weight: _Numbers = ...,
        dry_loads: _Numbers = ...,
        pretension: float = ...,
        seabed: bool = ...,
        friction: float = ...,
        breaking_load: _Numbers = ...,
        breaks: bool = ...,
    ) -> str:
        """Add `[[force]]` with the type "catenary".

        Quasi-static elastic mooring line of one or more parts, with seabed, clumps and buoys.

        Parameters
        ----------
        name : text
            Name of this force in the results.
        body_a : text, default "ground"
            Body of end A, or ground: the anchor.
        body_b : text
            Body of end B: the fairlead.
        point_a : 3 numbers, m
            End A in the reference pose, world axes.
        point_b : 3 numbers, m
            End B in the reference pose, world axes.
        length : list of numbers, m
            Unstretched lengths of the parts, from A to B. Allowed: > 0.
        weight : list of numbers, N/m
            Weights in water per unstretched length of the parts.
        stiffness : list of numbers, N
            Axial stiffnesses EA of the parts. Allowed: > 0.
        loads : list of numbers, N, optional
            Weights in water of what hangs between the parts: clumps; negative: buoys.
        dry_weight : list of numbers, N/m, optional
            Weights out of the water per unstretched length of the parts. Default: as in water,
            zero where they float. Allowed: >= 0.
        dry_loads : list of numbers, N, optional
            Weights out of the water of what hangs between the parts, spheres at the surface.
            Default: as in water, zero where they float.
        pretension : number, N, optional
            Tension at B in the reference pose; the length of the first part follows from it.
            Allowed: > 0.
        seabed : true or false, default true
            Whether a flat seabed at the height of A carries the line.
        friction : number, default 0
            Friction coefficient of the seabed. Allowed: >= 0.
        breaking_load : list of numbers, N, optional
            Tensions that the parts bear, one number or one each; the summary reports where they
            are exceeded. Allowed: > 0.
        breaks : true or false, default false
            Whether it parts for good where its tension reaches `breaking_load`.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def library_load(
        self,
        name: str,
        *,
        joint: str,
        law: str,
        coordinate: str = ...,
        parameters: _Numbers = ...,
    ) -> str:
        """Add `[[force]]` with the type "library_load".

        Load along a joint by a law of a shared library, which is given to the run.

        Parameters
        ----------
        name : text
            Name of this force in the results.
        joint : text
            Joint along which it acts.
        coordinate : text, optional
            Which coordinate of the joint: displacement, angle, angle_2, ...; default: its only
            one.
        law : text
            Name of the law in its library.
        parameters : list of numbers, as the law says, optional
            Numbers that the law takes.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def library_wrench(
        self,
        name: str,
        *,
        body: str,
        law: str,
        parameters: _Numbers = ...,
    ) -> str:
        """Add `[[force]]` with the type "library_wrench".

        Force and moment on a body by a law of a shared library, which is given to the run.

        Parameters
        ----------
        name : text
            Name of this force in the results.
        body : text
            Body that is loaded.
        law : text
            Name of the law in its library.
        parameters : list of numbers, as the law says, optional
            Numbers that the law takes.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def line(
        self,
        name: str,
        *,
        point_a: _Numbers,
        length: _Numbers,
        mass: _Numbers,
        stiffness: _Numbers,
        body_a: str = ...,
        body_b: str = ...,
        point_b: _Numbers = ...,
        free_end: bool = ...,
        segments: _Numbers = ...,
        diameter: _Numbers = ...,
        damping: _Numbers = ...,
        damping_ratio: _Numbers = ...,
        damps_slack: bool = ...,
        bending_stiffness: _Numbers = ...,
        drag: _Numbers = ...,
        drag_axial: _Numbers = ...,
        added_mass: _Numbers = ...,
        added_mass_axial: _Numbers = ...,
        breaking_load: _Numbers = ...,
        breaks: bool = ...,
        contact_diameter: _Numbers = ...,
        pretension: float = ...,
        attachment_at: _Numbers = ...,
        attachment_mass: _Numbers = ...,
        attachment_volume: _Numbers = ...,
        attachment_drag_area: _Numbers = ...,
        attachment_added_mass: _Numbers = ...,
        seabed: bool = ...,
        seabed_depth: float = ...,
        seabed_stiffness: float = ...,
        seabed_damping: float = ...,
        seabed_damps_up: bool = ...,
        seabed_friction: float = ...,
        water_density: float = ...,
        waves: bool = ...,
    ) -> str:
        """Add `[[force]]` with the type "line".

        Dynamic mooring line: masses on elastic segments in the water, with a seabed.

        Parameters
        ----------
        name : text
            Name of this force in the results.
        body_a : text, default "ground"
            Body of end A, or ground.
        body_b : text, default "ground"
            Body of end B, or ground.
        point_a : 3 numbers, m
            End A in the reference pose, world axes.
        point_b : 3 numbers, m, default [0, 0, 0]
            End B in the reference pose, world axes; of a free end: towards where it lies on the
            seabed.
        free_end : true or false, default false
            Whether end B is free.
        length : list of numbers, m
            Unstretched lengths of the parts, from A to B. Allowed: > 0.
        segments : list of numbers, optional
            Segments of each part; 20 by default. Allowed: 1 to 5000.
        mass : list of numbers, kg/m
            Masses per unstretched length, dry. Allowed: > 0.
        diameter : list of numbers, m, optional
            Diameters D of cylinders of the same volume; 0, the default: no buoyancy, no drag
            and no added mass. Allowed: >= 0.
        stiffness : list of numbers, N
            Axial stiffnesses EA of the parts. Allowed: > 0.
        damping : list of numbers, N s, optional
            Axial dampings C: tension C strain'. Allowed: >= 0.
        damping_ratio : list of numbers, optional
            In place of `damping`, C = ratio l sqrt(EA m): part of the critical damping of a
            segment. Allowed: >= 0.
        damps_slack : true or false, default false
            Whether the axial damping acts in slack segments too, which then push and pull by
            it, as in MoorDyn; by default it fades where the tension does.
        bending_stiffness : list of numbers, N m2, optional
            Bending stiffnesses EI; ends turn freely. Allowed: >= 0.
        drag : list of numbers, optional
            C_d: drag across the line, over D. Allowed: >= 0.
        drag_axial : list of numbers, optional
            C_dt: drag along the line, over pi D. Allowed: >= 0.
        added_mass : list of numbers, optional
            C_a across the line; the inertia force is rho V (1 + C_a). Allowed: >= 0.
        added_mass_axial : list of numbers, optional
            C_at: added mass along the line. Allowed: >= 0.
        breaking_load : list of numbers, N, optional
            Breaking loads of the parts; the summary reports where they are exceeded. Allowed: >
            0.
        breaks : true or false, default false
            Whether the segment parts for good whose tension reaches `breaking_load`.
        contact_diameter : list of numbers, m, optional
            Width of the parts where they lie on the seabed, their axes half of it above: links
            are wider than D; default: D, the axis on the seabed. Allowed: > 0.
        pretension : number, N, optional
            Tension at B in the reference pose; the length of the first part follows from it.
            Allowed: > 0.
        attachment_at : list of numbers, m, optional
            Unstretched lengths from A at which clumps and buoys hang, each between two
            segments. Allowed: >= 0.
        attachment_mass : list of numbers, kg, optional
            Their masses. Allowed: >= 0.
        attachment_volume : list of numbers, m3, optional
            Their volumes. Allowed: >= 0.
        attachment_drag_area : list of numbers, m2, optional
            Their drag areas C_d A. Allowed: >= 0.
        attachment_added_mass : list of numbers, optional
            Their added-mass coefficients C_a, over the volume. Allowed: >= 0.
        seabed : true or false, default true
            Whether the seabed carries the line, where there is one.
        seabed_depth : number, m, optional
            Depth of the seabed; default: that of the water. Allowed: > 0.
        seabed_stiffness : number, N/m3, optional
            Normal stiffness of the seabed, over the width in contact; default: the line lies a
            tenth of D deep. Allowed: > 0.
        seabed_damping : number, N s/m3, default 0
            Normal damping of the seabed, over the same width, on the way down. Allowed: >= 0.
        seabed_damps_up : true or false, default false
            Whether that damping acts on the way up too, where the seabed may pull, as in
            MoorDyn.
        seabed_friction : number, default 0
            Friction coefficient of the seabed in motion, smooth within about 0.01 m/s; zero at
            rest. Allowed: >= 0.
        water_density : number, kg/m3, optional
            Density of the water that buoyancy, drag and added mass of the line are by; default:
            that of the case. `check` prints where they differ. Allowed: > 0.
        waves : true or false, default true
            Whether the line feels the waves; it always feels the current.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def pto_lagged(
        self,
        name: str,
        *,
        joint: str,
        lag: float,
        load_limit: float,
        coordinate: str = ...,
        stiffness: float = ...,
        neutral: float = ...,
        damping: float = ...,
    ) -> str:
        """Add `[[force]]` with the type "pto_lagged".

        Power take-off along a joint whose load follows -k (s - s0) - c s' with a lag.

        Parameters
        ----------
        name : text
            Name of this force in the results.
        joint : text
            Joint along which it acts.
        coordinate : text, optional
            Which coordinate of the joint: displacement, angle, angle_2, ...; default: its only
            one.
        lag : number, s
            Time constant T of the machine. Allowed: > 0.
        stiffness : number, N/m or N m/rad, default 0
            Stiffness k; negative: it pushes away from `neutral`.
        neutral : number, m or rad, default 0
            Joint coordinate s0 at which the spring is slack.
        damping : number, N s/m or N m s/rad, default 0
            Damping c. Allowed: >= 0.
        load_limit : number, N or N m
            Largest load F_max that is asked for. Allowed: > 0.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """

class OutletTypes(TypedList):
    """What lets air out of a chamber and in: an orifice, a plug, a turbine."""

    def orifice(
        self,
        name: str,
        *,
        chamber: str,
        coefficient: float,
        area: float,
        to: str = ...,
        laminar_pressure: float = ...,
        opening: float = ...,
    ) -> str:
        """Add `[[outlet]]` with the type "orifice".

        An orifice: the flow goes with the root of the drop of pressure, until it chokes.

        Parameters
        ----------
        name : text
            Name of the outlet in the results.
        chamber : text
            Chamber that it opens.
        to : text, optional
            Chamber to which it leads; default: the atmosphere.
        coefficient : number
            Discharge coefficient C. Allowed: > 0, <= 1.
        area : number, m2
            Area A of the hole. Allowed: > 0.
        laminar_pressure : number, Pa, default 1
            Drop of pressure p_l below which the flow is linear: it removes the endless slope of
            a root at zero. A larger one makes runs cheaper. Allowed: > 0.
        opening : number, default 1
            Part of the area that is open at the start. A controller may write it. Allowed: 0 to
            1.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def porous_plug(
        self,
        name: str,
        *,
        chamber: str,
        conductance: float,
        to: str = ...,
    ) -> str:
        """Add `[[outlet]]` with the type "porous_plug".

        A porous plug: the mass flow is proportional to the drop of pressure.

        Parameters
        ----------
        name : text
            Name of the outlet in the results.
        chamber : text
            Chamber that it opens.
        to : text, optional
            Chamber to which it leads; default: the atmosphere.
        conductance : number, kg/(s Pa)
            Mass flow k for each pascal of the drop. Allowed: > 0.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def valve(
        self,
        name: str,
        *,
        chamber: str,
        coefficient: float,
        area: float,
        to: str = ...,
        laminar_pressure: float = ...,
        opens_at: float = ...,
        shuts_at: float = ...,
        direction: _ValveDirection = ...,
    ) -> str:
        """Add `[[outlet]]` with the type "valve".

        A check, relief or bypass valve: the drop of pressure opens it, and shuts it below.

        Parameters
        ----------
        name : text
            Name of the outlet in the results.
        chamber : text
            Chamber that it opens.
        to : text, optional
            Chamber to which it leads; default: the atmosphere.
        coefficient : number
            Discharge coefficient C. Allowed: > 0, <= 1.
        area : number, m2
            Area A of the hole. Allowed: > 0.
        laminar_pressure : number, Pa, default 1
            Drop of pressure p_l below which the flow is linear: it removes the endless slope of
            a root at zero. A larger one makes runs cheaper. Allowed: > 0.
        opens_at : number, Pa, default 0
            Drop of pressure at which it opens. Allowed: >= 0.
        shuts_at : number, Pa, default 0
            Drop of pressure at which it shuts. Allowed: >= 0.
        direction : text, default "out"
            Which way it lets the air: out of its chamber, in, or both. Allowed: out, in, both.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def wells(
        self,
        name: str,
        *,
        chamber: str,
        diameter: float,
        speed: float,
        flow_slope: float,
        to: str = ...,
        inertia: float = ...,
        windage: float = ...,
        torque: float = ...,
        torque_exponent: float = ...,
        torque_at: _Numbers = ...,
        torque_load: _Numbers = ...,
        efficiency_at: _Numbers = ...,
        efficiency: _Numbers = ...,
        generator_efficiency: float = ...,
        stall: float = ...,
        stall_slope: float = ...,
    ) -> str:
        """Add `[[outlet]]` with the type "wells".

        A Wells turbine: its flow is proportional to the drop of pressure, until it stalls.

        Parameters
        ----------
        name : text
            Name of the outlet in the results.
        chamber : text
            Chamber that it opens.
        to : text, optional
            Chamber to which it leads; default: the atmosphere.
        diameter : number, m
            Diameter D of the rotor. Allowed: > 0.
        speed : number, rad/s
            Speed W of rotation: it stays, or with `inertia` begins so. A controller may write a
            speed that stays. Allowed: > 0.
        inertia : number, kg m2, optional
            Moment of inertia I of the rotor with the generator; with it the speed is a state.
            Allowed: > 0.
        windage : number, N m s2/rad2, default 0
            Torque a_w W^2 that friction in the air takes. Allowed: >= 0.
        torque : number, N m (s/rad)^b, default 0
            Coefficient a of the generator's torque a W^b. Allowed: >= 0.
        torque_exponent : number, default 2
            Its exponent b. Allowed: 0 to 10.
        torque_at : list of numbers, rad/s, optional
            Speeds at which the torque of the generator is given instead. Allowed: >= 0.
        torque_load : list of numbers, N m, optional
            That torque at these speeds. Allowed: >= 0.
        efficiency_at : list of numbers, optional
            Dimensionless pressures |Psi| at which the efficiency is given, from 0 on. Allowed:
            >= 0.
        efficiency : list of numbers, optional
            Power at the shaft over p m / rho_in at these; negative where the shaft drives the
            air. Without it the shaft has no torque. Allowed: <= 1.
        generator_efficiency : number, default 1
            Electric power over that at the shaft. Allowed: 0 to 1.
        flow_slope : number
            K of Phi = K Psi: flow over pressure, both dimensionless. Allowed: > 0.
        stall : number, optional
            Dimensionless pressure Psi_s at which it stalls; default: it never does. Allowed: >
            0.
        stall_slope : number, optional
            K_s, the slope of Phi beyond. Allowed: >= 0.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def impulse(
        self,
        name: str,
        *,
        chamber: str,
        diameter: float,
        speed: float,
        coefficient: float,
        exponent: float,
        to: str = ...,
        inertia: float = ...,
        windage: float = ...,
        torque: float = ...,
        torque_exponent: float = ...,
        torque_at: _Numbers = ...,
        torque_load: _Numbers = ...,
        efficiency_at: _Numbers = ...,
        efficiency: _Numbers = ...,
        generator_efficiency: float = ...,
        laminar: float = ...,
    ) -> str:
        """Add `[[outlet]]` with the type "impulse".

        An axial impulse turbine: its flow is a power of the drop of pressure.

        Parameters
        ----------
        name : text
            Name of the outlet in the results.
        chamber : text
            Chamber that it opens.
        to : text, optional
            Chamber to which it leads; default: the atmosphere.
        diameter : number, m
            Diameter D of the rotor. Allowed: > 0.
        speed : number, rad/s
            Speed W of rotation: it stays, or with `inertia` begins so. A controller may write a
            speed that stays. Allowed: > 0.
        inertia : number, kg m2, optional
            Moment of inertia I of the rotor with the generator; with it the speed is a state.
            Allowed: > 0.
        windage : number, N m s2/rad2, default 0
            Torque a_w W^2 that friction in the air takes. Allowed: >= 0.
        torque : number, N m (s/rad)^b, default 0
            Coefficient a of the generator's torque a W^b. Allowed: >= 0.
        torque_exponent : number, default 2
            Its exponent b. Allowed: 0 to 10.
        torque_at : list of numbers, rad/s, optional
            Speeds at which the torque of the generator is given instead. Allowed: >= 0.
        torque_load : list of numbers, N m, optional
            That torque at these speeds. Allowed: >= 0.
        efficiency_at : list of numbers, optional
            Dimensionless pressures |Psi| at which the efficiency is given, from 0 on. Allowed:
            >= 0.
        efficiency : list of numbers, optional
            Power at the shaft over p m / rho_in at these; negative where the shaft drives the
            air. Without it the shaft has no torque. Allowed: <= 1.
        generator_efficiency : number, default 1
            Electric power over that at the shaft. Allowed: 0 to 1.
        coefficient : number
            c of Phi = c |Psi|^e. Allowed: > 0.
        exponent : number
            e of Phi = c |Psi|^e. Allowed: > 0, <= 1.
        laminar : number, default 0.0001
            Dimensionless pressure Psi_l below which the flow is linear: it removes the endless
            slope at zero. Allowed: > 0.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def biradial(
        self,
        name: str,
        *,
        chamber: str,
        diameter: float,
        speed: float,
        to: str = ...,
        inertia: float = ...,
        windage: float = ...,
        torque: float = ...,
        torque_exponent: float = ...,
        torque_at: _Numbers = ...,
        torque_load: _Numbers = ...,
        efficiency_at: _Numbers = ...,
        efficiency: _Numbers = ...,
        generator_efficiency: float = ...,
        coefficient: float = ...,
        exponent: float = ...,
        laminar: float = ...,
    ) -> str:
        """Add `[[outlet]]` with the type "biradial".

        A biradial turbine: its flow goes with the power 0.6 of the drop of pressure.

        Parameters
        ----------
        name : text
            Name of the outlet in the results.
        chamber : text
            Chamber that it opens.
        to : text, optional
            Chamber to which it leads; default: the atmosphere.
        diameter : number, m
            Diameter D of the rotor. Allowed: > 0.
        speed : number, rad/s
            Speed W of rotation: it stays, or with `inertia` begins so. A controller may write a
            speed that stays. Allowed: > 0.
        inertia : number, kg m2, optional
            Moment of inertia I of the rotor with the generator; with it the speed is a state.
            Allowed: > 0.
        windage : number, N m s2/rad2, default 0
            Torque a_w W^2 that friction in the air takes. Allowed: >= 0.
        torque : number, N m (s/rad)^b, default 0
            Coefficient a of the generator's torque a W^b. Allowed: >= 0.
        torque_exponent : number, default 2
            Its exponent b. Allowed: 0 to 10.
        torque_at : list of numbers, rad/s, optional
            Speeds at which the torque of the generator is given instead. Allowed: >= 0.
        torque_load : list of numbers, N m, optional
            That torque at these speeds. Allowed: >= 0.
        efficiency_at : list of numbers, optional
            Dimensionless pressures |Psi| at which the efficiency is given, from 0 on. Allowed:
            >= 0.
        efficiency : list of numbers, optional
            Power at the shaft over p m / rho_in at these; negative where the shaft drives the
            air. Without it the shaft has no torque. Allowed: <= 1.
        generator_efficiency : number, default 1
            Electric power over that at the shaft. Allowed: 0 to 1.
        coefficient : number, default 0.195
            c of Phi = c |Psi|^e. Allowed: > 0.
        exponent : number, default 0.6
            e of Phi = c |Psi|^e. Allowed: > 0, <= 1.
        laminar : number, default 0.0001
            Dimensionless pressure Psi_l below which the flow is linear: it removes the endless
            slope at zero. Allowed: > 0.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def turbine(
        self,
        name: str,
        *,
        chamber: str,
        diameter: float,
        speed: float,
        flow_at: _Numbers,
        flow: _Numbers,
        to: str = ...,
        inertia: float = ...,
        windage: float = ...,
        torque: float = ...,
        torque_exponent: float = ...,
        torque_at: _Numbers = ...,
        torque_load: _Numbers = ...,
        efficiency_at: _Numbers = ...,
        efficiency: _Numbers = ...,
        generator_efficiency: float = ...,
    ) -> str:
        """Add `[[outlet]]` with the type "turbine".

        A turbine by measured points: dimensionless flow over dimensionless pressure.

        Parameters
        ----------
        name : text
            Name of the outlet in the results.
        chamber : text
            Chamber that it opens.
        to : text, optional
            Chamber to which it leads; default: the atmosphere.
        diameter : number, m
            Diameter D of the rotor. Allowed: > 0.
        speed : number, rad/s
            Speed W of rotation: it stays, or with `inertia` begins so. A controller may write a
            speed that stays. Allowed: > 0.
        inertia : number, kg m2, optional
            Moment of inertia I of the rotor with the generator; with it the speed is a state.
            Allowed: > 0.
        windage : number, N m s2/rad2, default 0
            Torque a_w W^2 that friction in the air takes. Allowed: >= 0.
        torque : number, N m (s/rad)^b, default 0
            Coefficient a of the generator's torque a W^b. Allowed: >= 0.
        torque_exponent : number, default 2
            Its exponent b. Allowed: 0 to 10.
        torque_at : list of numbers, rad/s, optional
            Speeds at which the torque of the generator is given instead. Allowed: >= 0.
        torque_load : list of numbers, N m, optional
            That torque at these speeds. Allowed: >= 0.
        efficiency_at : list of numbers, optional
            Dimensionless pressures |Psi| at which the efficiency is given, from 0 on. Allowed:
            >= 0.
        efficiency : list of numbers, optional
            Power at the shaft over p m / rho_in at these; negative where the shaft drives the
            air. Without it the shaft has no torque. Allowed: <= 1.
        generator_efficiency : number, default 1
            Electric power over that at the shaft. Allowed: 0 to 1.
        flow_at : list of numbers
            Dimensionless pressures |Psi|, from 0 on. Allowed: >= 0.
        flow : list of numbers
            Dimensionless flow |Phi| at these, from 0 on. Allowed: >= 0.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """

class ControllerTypes(TypedList):
    """A sampled controller: it reads channels, and holds inputs between its instants."""

    def pid(
        self,
        name: str,
        *,
        inputs: str | Sequence[str],
        outputs: str | Sequence[str],
        period: float,
        delay: float = ...,
        lag: float = ...,
        gain_p: float = ...,
        gain_i: float = ...,
        gain_d: float = ...,
        filter_time: float = ...,
        target: float = ...,
        lower: float = ...,
        upper: float = ...,
        tracking_time: float = ...,
    ) -> str:
        """Add `[[controller]]` with the type "pid".

        u = Kp e + Ki int e + Kd e' with e = target - input; within limits.

        Parameters
        ----------
        name : text
            Name of the controller in the results.
        inputs : text or list of texts
            Channels that it reads, as in the results; of a vector one component:
            "bodies/float/velocity.z". In another unit of the same dimension where one stands
            behind the name: "joints/hinge/angle [deg]".
        outputs : text or list of texts
            Inputs of the scene that it writes, such as "forces/pto/load" (hydrodae check lists
            them); "forces/pto/load [kN]" where it answers in another unit.
        period : number, s
            Time T between two sampling instants; the first is the start. Allowed: > 0.
        delay : number, s, default 0
            Time from a sampling instant to the one when its answer holds. Allowed: >= 0.
        lag : number, s, default 0
            Time constant of the actuator: its output follows what the controller holds like a
            filter of first order. Allowed: >= 0.
        gain_p : number, out per in, default 0
            Proportional gain Kp.
        gain_i : number, out per in and s, default 0
            Integral gain Ki.
        gain_d : number, out s per in, default 0
            Derivative gain Kd.
        filter_time : number, s, default 0
            Time constant of the filter of first order on the derivative. Allowed: >= 0.
        target : number, unit of the input, default 0
            What the input is to be, where no second input gives it.
        lower : number, unit of the output, optional
            Least output.
        upper : number, unit of the output, optional
            Largest output.
        tracking_time : number, s, optional
            Time in which the integral follows an output at its limit (back-calculation);
            default |Kp / Ki|. Allowed: > 0.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def reactive(
        self,
        name: str,
        *,
        inputs: str | Sequence[str],
        outputs: str | Sequence[str],
        period: float,
        delay: float = ...,
        lag: float = ...,
        stiffness: float = ...,
        damping: float = ...,
        neutral: float = ...,
        limit: float = ...,
    ) -> str:
        """Add `[[controller]]` with the type "reactive".

        u = -K (s - s0) - C s' of a coordinate and its rate.

        Parameters
        ----------
        name : text
            Name of the controller in the results.
        inputs : text or list of texts
            Channels that it reads, as in the results; of a vector one component:
            "bodies/float/velocity.z". In another unit of the same dimension where one stands
            behind the name: "joints/hinge/angle [deg]".
        outputs : text or list of texts
            Inputs of the scene that it writes, such as "forces/pto/load" (hydrodae check lists
            them); "forces/pto/load [kN]" where it answers in another unit.
        period : number, s
            Time T between two sampling instants; the first is the start. Allowed: > 0.
        delay : number, s, default 0
            Time from a sampling instant to the one when its answer holds. Allowed: >= 0.
        lag : number, s, default 0
            Time constant of the actuator: its output follows what the controller holds like a
            filter of first order. Allowed: >= 0.
        stiffness : number, N/m or N m/rad, default 0
            Stiffness K; negative: it pushes away.
        damping : number, N s/m or N m s/rad, default 0
            Damping C.
        neutral : number, m or rad, default 0
            Coordinate s0 at which the spring is slack.
        limit : number, N or N m, optional
            Largest load, either way. Allowed: > 0.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def resistive(
        self,
        name: str,
        *,
        inputs: str | Sequence[str],
        outputs: str | Sequence[str],
        period: float,
        delay: float = ...,
        lag: float = ...,
        damping: float = ...,
        limit: float = ...,
    ) -> str:
        """Add `[[controller]]` with the type "resistive".

        u = -C s' of a rate.

        Parameters
        ----------
        name : text
            Name of the controller in the results.
        inputs : text or list of texts
            Channels that it reads, as in the results; of a vector one component:
            "bodies/float/velocity.z". In another unit of the same dimension where one stands
            behind the name: "joints/hinge/angle [deg]".
        outputs : text or list of texts
            Inputs of the scene that it writes, such as "forces/pto/load" (hydrodae check lists
            them); "forces/pto/load [kN]" where it answers in another unit.
        period : number, s
            Time T between two sampling instants; the first is the start. Allowed: > 0.
        delay : number, s, default 0
            Time from a sampling instant to the one when its answer holds. Allowed: >= 0.
        lag : number, s, default 0
            Time constant of the actuator: its output follows what the controller holds like a
            filter of first order. Allowed: >= 0.
        damping : number, N s/m or N m s/rad, default 0
            Damping C.
        limit : number, N or N m, optional
            Largest load, either way. Allowed: > 0.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def bang_bang(
        self,
        name: str,
        *,
        inputs: str | Sequence[str],
        outputs: str | Sequence[str],
        period: float,
        lower: float,
        upper: float,
        delay: float = ...,
        lag: float = ...,
        target: float = ...,
        band: float = ...,
    ) -> str:
        """Add `[[controller]]` with the type "bang_bang".

        u = upper or lower by the sign of e = target - input, with hysteresis.

        Parameters
        ----------
        name : text
            Name of the controller in the results.
        inputs : text or list of texts
            Channels that it reads, as in the results; of a vector one component:
            "bodies/float/velocity.z". In another unit of the same dimension where one stands
            behind the name: "joints/hinge/angle [deg]".
        outputs : text or list of texts
            Inputs of the scene that it writes, such as "forces/pto/load" (hydrodae check lists
            them); "forces/pto/load [kN]" where it answers in another unit.
        period : number, s
            Time T between two sampling instants; the first is the start. Allowed: > 0.
        delay : number, s, default 0
            Time from a sampling instant to the one when its answer holds. Allowed: >= 0.
        lag : number, s, default 0
            Time constant of the actuator: its output follows what the controller holds like a
            filter of first order. Allowed: >= 0.
        target : number, unit of the input, default 0
            What the input is to be, where no second input gives it.
        band : number, unit of the input, default 0
            Half width of the hysteresis: within it the output stays. Allowed: >= 0.
        lower : number, unit of the output
            Least output.
        upper : number, unit of the output
            Largest output.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def latching(
        self,
        name: str,
        *,
        inputs: str | Sequence[str],
        outputs: str | Sequence[str],
        period: float,
        hold_time: float,
        hold_load: float,
    ) -> str:
        """Add `[[controller]]` with the type "latching".

        Holds a joint by its dry friction from a standstill on, for some time.

        Parameters
        ----------
        name : text
            Name of the controller in the results.
        inputs : text or list of texts
            Channels that it reads, as in the results; of a vector one component:
            "bodies/float/velocity.z". In another unit of the same dimension where one stands
            behind the name: "joints/hinge/angle [deg]".
        outputs : text or list of texts
            Inputs of the scene that it writes, such as "forces/pto/load" (hydrodae check lists
            them); "forces/pto/load [kN]" where it answers in another unit.
        period : number, s
            Time T between two sampling instants; the first is the start. Allowed: > 0.
        hold_time : number, s
            How long it holds from the standstill on. Allowed: > 0.
        hold_load : number, N or N m
            Largest load that it holds. Allowed: > 0.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def declutching(
        self,
        name: str,
        *,
        inputs: str | Sequence[str],
        outputs: str | Sequence[str],
        period: float,
        engaged: float,
        free_time: float,
        lag: float = ...,
        free: float = ...,
    ) -> str:
        """Add `[[controller]]` with the type "declutching".

        Frees a machine from each standstill of a joint on, for some time; else it works.

        Parameters
        ----------
        name : text
            Name of the controller in the results.
        inputs : text or list of texts
            Channels that it reads, as in the results; of a vector one component:
            "bodies/float/velocity.z". In another unit of the same dimension where one stands
            behind the name: "joints/hinge/angle [deg]".
        outputs : text or list of texts
            Inputs of the scene that it writes, such as "forces/pto/load" (hydrodae check lists
            them); "forces/pto/load [kN]" where it answers in another unit.
        period : number, s
            Time T between two sampling instants; the first is the start. Allowed: > 0.
        lag : number, s, default 0
            Time constant of the actuator: its output follows what the controller holds like a
            filter of first order. Allowed: >= 0.
        engaged : number, unit of the output
            Output while the machine works.
        free : number, unit of the output, default 0
            Output while the machine is free.
        free_time : number, s
            How long it is free from a standstill on. Allowed: > 0.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def table(
        self,
        name: str,
        *,
        inputs: str | Sequence[str],
        outputs: str | Sequence[str],
        period: float,
        at: _Numbers,
        value: _Numbers,
        delay: float = ...,
        lag: float = ...,
    ) -> str:
        """Add `[[controller]]` with the type "table".

        u as a function of one channel, straight lines between points.

        Parameters
        ----------
        name : text
            Name of the controller in the results.
        inputs : text or list of texts
            Channels that it reads, as in the results; of a vector one component:
            "bodies/float/velocity.z". In another unit of the same dimension where one stands
            behind the name: "joints/hinge/angle [deg]".
        outputs : text or list of texts
            Inputs of the scene that it writes, such as "forces/pto/load" (hydrodae check lists
            them); "forces/pto/load [kN]" where it answers in another unit.
        period : number, s
            Time T between two sampling instants; the first is the start. Allowed: > 0.
        delay : number, s, default 0
            Time from a sampling instant to the one when its answer holds. Allowed: >= 0.
        lag : number, s, default 0
            Time constant of the actuator: its output follows what the controller holds like a
            filter of first order. Allowed: >= 0.
        at : list of numbers, unit of the input
            Values of the input, ascending.
        value : list of numbers, unit of the output
            Outputs there; beyond the ends those at the ends.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def python(
        self,
        name: str,
        *,
        outputs: str | Sequence[str],
        period: float,
        inputs: str | Sequence[str] = ...,
        delay: float = ...,
        lag: float = ...,
    ) -> str:
        """Add `[[controller]]` with the type "python".

        A Python function or object, given to the run.

        Parameters
        ----------
        name : text
            Name of the controller in the results.
        inputs : text or list of texts, optional
            Channels that it reads, as in the results; of a vector one component:
            "bodies/float/velocity.z". In another unit of the same dimension where one stands
            behind the name: "joints/hinge/angle [deg]".
        outputs : text or list of texts
            Inputs of the scene that it writes, such as "forces/pto/load" (hydrodae check lists
            them); "forces/pto/load [kN]" where it answers in another unit.
        period : number, s
            Time T between two sampling instants; the first is the start. Allowed: > 0.
        delay : number, s, default 0
            Time from a sampling instant to the one when its answer holds. Allowed: >= 0.
        lag : number, s, default 0
            Time constant of the actuator: its output follows what the controller holds like a
            filter of first order. Allowed: >= 0.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def tcp(
        self,
        name: str,
        *,
        outputs: str | Sequence[str],
        period: float,
        inputs: str | Sequence[str] = ...,
        delay: float = ...,
        lag: float = ...,
        protocol: _TcpProtocol = ...,
        role: _TcpRole = ...,
        host: str = ...,
        port: int = ...,
        timeout: float = ...,
        connect_timeout: float = ...,
    ) -> str:
        """Add `[[controller]]` with the type "tcp".

        Another program, over TCP/IP in lock-step.

        Parameters
        ----------
        name : text
            Name of the controller in the results.
        inputs : text or list of texts, optional
            Channels that it reads, as in the results; of a vector one component:
            "bodies/float/velocity.z". In another unit of the same dimension where one stands
            behind the name: "joints/hinge/angle [deg]".
        outputs : text or list of texts
            Inputs of the scene that it writes, such as "forces/pto/load" (hydrodae check lists
            them); "forces/pto/load [kN]" where it answers in another unit.
        period : number, s
            Time T between two sampling instants; the first is the start. Allowed: > 0.
        delay : number, s, default 0
            Time from a sampling instant to the one when its answer holds. Allowed: >= 0.
        lag : number, s, default 0
            Time constant of the actuator: its output follows what the controller holds like a
            filter of first order. Allowed: >= 0.
        protocol : text, default "hydrodae"
            hydrodae: a handshake with names and units, then numbered frames; hotint: bare
            numbers with a flag (docs/tcp.md). Allowed: hydrodae, hotint.
        role : text, default "server"
            server: the other program connects to the run; client: the run connects to it.
            Allowed: server, client.
        host : text, default "127.0.0.1"
            Address at which a server listens, or to which a client connects.
        port : integer, default 50000
            TCP port. Allowed: 1 to 65535.
        timeout : number, s, default 10
            Longest wait for an answer. Allowed: > 0.
        connect_timeout : number, s, default 60
            Longest wait for the other program to be there. Allowed: > 0.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def fmu(
        self,
        name: str,
        *,
        outputs: str | Sequence[str],
        period: float,
        file: str,
        fmu_outputs: str | Sequence[str],
        inputs: str | Sequence[str] = ...,
        delay: float = ...,
        lag: float = ...,
        fmu_inputs: str | Sequence[str] = ...,
        fmu_factors: _Numbers = ...,
        parameters: str | Sequence[str] = ...,
        parameter_values: _Numbers = ...,
        text_parameters: str | Sequence[str] = ...,
        text_values: str | Sequence[str] = ...,
    ) -> str:
        """Add `[[controller]]` with the type "fmu".

        An FMU for co-simulation (fmi-standard.org).

        Parameters
        ----------
        name : text
            Name of the controller in the results.
        inputs : text or list of texts, optional
            Channels that it reads, as in the results; of a vector one component:
            "bodies/float/velocity.z". In another unit of the same dimension where one stands
            behind the name: "joints/hinge/angle [deg]".
        outputs : text or list of texts
            Inputs of the scene that it writes, such as "forces/pto/load" (hydrodae check lists
            them); "forces/pto/load [kN]" where it answers in another unit.
        period : number, s
            Time T between two sampling instants; the first is the start. Allowed: > 0.
        delay : number, s, default 0
            Time from a sampling instant to the one when its answer holds. Allowed: >= 0.
        lag : number, s, default 0
            Time constant of the actuator: its output follows what the controller holds like a
            filter of first order. Allowed: >= 0.
        file : text
            FMU for co-simulation, version 2.0 or 3.0 of FMI.
        fmu_inputs : text or list of texts, optional
            Its input for each of `inputs`.
        fmu_outputs : text or list of texts
            Its output for each of `outputs`.
        fmu_factors : list of numbers, unit of the output per that of the FMU, optional
            What each of these is multiplied by; default 1.
        parameters : text or list of texts, optional
            Numbers, booleans (0 or 1) and enumerations of it that are set before the start.
        parameter_values : list of numbers, as the FMU says, optional
            Their values.
        text_parameters : text or list of texts, optional
            Strings of it that are set before the start.
        text_values : text or list of texts, optional
            Their values.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """

class Scene(SceneBase):
    """A scene that is built call by call; `hydrodae.run` and the other functions take it."""

    def environment(
        self,
        *,
        gravity: float = ...,
        water_density: float = ...,
        water_depth: float = ...,
        air_pressure: float = ...,
        air_density: float = ...,
    ) -> None:
        """Add `[environment]`.

        Gravity, the water where no hydrodynamic database states it, and the air.

        Parameters
        ----------
        gravity : number, m/s2, optional
            Acceleration of gravity, along -z; default: that of the database, without one 9.81.
            Allowed: >= 0.
        water_density : number, kg/m3, optional
            Density of the water, where there is no hydrodynamic database. Allowed: > 0.
        water_depth : number, m, optional
            Depth of the water, where there is no hydrodynamic database; infinite by default.
            Allowed: > 0.
        air_pressure : number, Pa, optional
            Pressure of the atmosphere around chambers, absolute; default: 101 325. Allowed: >
            0.
        air_density : number, kg/m3, optional
            Density of the air around chambers; default: 1.225. Allowed: > 0.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def hydro(
        self,
        *,
        database: str,
        axes: _HydroAxes = ...,
        radiation: _HydroRadiation = ...,
        memory_length: float = ...,
        frequency: float = ...,
        fit: str = ...,
    ) -> None:
        """Add `[hydro]`.

        The hydrodynamic database, and how the loads of the water are taken from it.

        Parameters
        ----------
        database : text
            Path of hydro.h5, relative to the case file.
        axes : text, default "mean"
            Axes in which added mass, radiation and excitation act. mean: earth axes turned by
            the yaw of each body at the start or in the equilibrium. yaw: axes that follow its
            yaw. body: axes that it carries, for large rotations in still water. Allowed: mean,
            yaw, body.
        radiation : text, default "exponential"
            Radiation. none: added mass at infinite frequency only. constant: added mass and
            damping at one frequency. exponential: the fitted memory. convolution: the kernel
            K(t). Allowed: none, constant, exponential, convolution.
        memory_length : number, s, optional
            Length of the kernel of the convolution; by default that of the database. Allowed: >
            0.
        frequency : number, rad/s, optional
            Frequency of added mass and damping of constant radiation. Allowed: > 0.
        fit : text, optional
            Name of the exponential fit; by default the one with the fewest states that covers
            the coordinates that move.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def pose_table(
        self,
        name: str,
        *,
        body: str,
        coordinate: _PoseTableCoordinate,
        databases: str | Sequence[str],
        values: _Numbers = ...,
        values_deg: _Numbers = ...,
        memory: _PoseTableMemory = ...,
    ) -> str:
        """Add `[[pose_table]]`.

        Added mass, radiation and excitation of one body by its pose: databases computed for
        several poses, blended by cubic splines.

        Parameters
        ----------
        name : text
            Name of the table.
        body : text
            Body whose pose it follows, and which it loads.
        coordinate : text
            Coordinate of the pose: the rise of the centre of gravity above the reference pose,
            or the angle of the body. Allowed: heave, roll, pitch, yaw.
        values : list of numbers, m, optional
            Heave of the databases, two or more in ascending order.
        values_deg : list of numbers, deg, optional
            Roll, pitch or yaw of the databases, two or more in ascending order.
        databases : text or list of texts
            Paths of the databases, one for each value, relative to the case file. Each is about
            the centre of gravity where it then is.
        memory : text, default "rest"
            Radiation memory of radiation = "exponential": that of the database in [hydro],
            passive at any pose (rest), or those of all poses, each multiplied by its weight
            (blended). Allowed: rest, blended.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def sea(
        self,
        *,
        ramp: float = ...,
        current: _Numbers = ...,
        phase: _SeaPhase = ...,
        stretching: _SeaStretching = ...,
        bernoulli: bool = ...,
    ) -> None:
        """Add `[sea]`.

        What all wave systems share, and the current.

        Parameters
        ----------
        ramp : number, s, default 0
            Time over which all waves grow from nothing, by a polynomial of degree 7 (three
            continuous derivatives). Allowed: >= 0.
        current : 3 numbers, m/s, default [0, 0, 0]
            Velocity of the water, the same everywhere, on which the Morison elements work; the
            waves do not feel it.
        phase : text, default "fixed"
            Where a body feels the phase of the waves: at its reference position (fixed), or
            where it is (moving: for bodies that drift; it costs a sum over all components in
            each evaluation). Allowed: fixed, moving.
        stretching : text, default "vertical"
            Pressure of the waves above z = 0 on bodies with `froude_krylov = "mesh"`. vertical:
            hydrostatic down from the crest, consistent to second order. wheeler: the linear
            profile moved up to the crest. extrapolated: e^(kz) as it is. none: the wetted part
            ends at z = 0. Allowed: vertical, wheeler, extrapolated, none.
        bernoulli : true or false, default false
            Whether the pressure on them has the term -rho u^2 / 2 of the waves' own velocity.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    @property
    def wave(self) -> WaveTypes:
        """One wave system; the sea is the sum of all, and still without any."""
    def body(
        self,
        name: str,
        *,
        mass: float | Literal["equilibrium"],
        center_of_gravity: _Numbers,
        motion: _BodyMotion | Sequence[_BodyMotion] = ...,
        inertia: _Numbers | Literal["mesh"] = ...,
        radii_of_gyration: _Numbers = ...,
        products_of_inertia: _Numbers = ...,
        principal_axes_deg: _Numbers = ...,
        hydro: str = ...,
        volume: float = ...,
        center_of_buoyancy: _Numbers = ...,
        mesh: str = ...,
        mesh_origin: _Numbers = ...,
        hydrostatics: _BodyHydrostatics = ...,
        froude_krylov: _BodyFroudeKrylov = ...,
        initial: BodyInitial = ...,
    ) -> str:
        """Add `[[body]]`.

        A rigid body.

        Parameters
        ----------
        name : text
            Name of the body.
        motion : text or list of texts, default "rigid"
            What the body can do: fixed, heave, planar (surge, heave, pitch), point (3
            translations), rigid (6), or a list of free coordinates. Allowed: fixed, planar,
            point, rigid, surge, sway, heave, roll, pitch, yaw.
        mass : number or text, kg
            Mass, or that of the water displaced in the reference pose (equilibrium). Allowed:
            >= 0 or equilibrium.
        center_of_gravity : 3 numbers, m
            Centre of gravity in the reference pose, world axes.
        inertia : 3 numbers or text, kg m2, default [0, 0, 0]
            Moments of inertia Ixx, Iyy, Izz about the centre of gravity, or those of a uniform
            solid that fills `mesh`, about its own centroid (mesh). Allowed: >= 0 or mesh.
        radii_of_gyration : 3 numbers, m, optional
            Radii r of gyration instead of `inertia`: the moments are m r^2. Allowed: >= 0.
        products_of_inertia : 3 numbers, kg m2, default [0, 0, 0]
            Ixy, Iyz, Izx as entries of the inertia tensor (Ixy = -sum m x y).
        principal_axes_deg : 3 numbers, deg, optional
            Rotation vector that turns the world axes into the principal axes of inertia in the
            reference pose; inertia then holds the principal moments.
        hydro : text, optional
            Name of this body in the hydrodynamic database; without it the body is dry.
        volume : number, m3, optional
            Volume of a body without `hydro` that is and stays under water: it has the buoyancy
            rho g V. That of a point (motion) is a sphere, whose buoyancy ends at z = 0.
            Allowed: > 0.
        center_of_buoyancy : 3 numbers, m, optional
            Centre of that volume in the reference pose, world axes; default: the centre of
            gravity.
        mesh : text, optional
            File (.stl or .obj, in metres, relative to the case file) of the closed surface of
            the body in the reference pose. World axes, normals outwards; it must reach above
            the highest water.
        mesh_origin : 3 numbers, m, default [0, 0, 0]
            Place of the origin of that file in the reference pose, world axes; for a mesh about
            the centre of gravity the place of that.
        hydrostatics : text, default "linear"
            Hydrostatics: the stiffness of the database about the reference pose (linear), or
            the pressure on the wetted part of `mesh` at each instant (mesh). Allowed: linear,
            mesh.
        froude_krylov : text, default "linear"
            Load of the undisturbed waves: that of the database about the mean pose (linear), or
            their pressure on the part of `mesh` beneath their surface (mesh). Diffraction and
            radiation stay those of the database. Allowed: linear, mesh.
        initial : dict, optional
            Start of the body, relative to its reference pose. Keys: displacement [m],
            rotation_deg [deg], velocity [m/s], angular_velocity [rad/s].

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def mode(
        self,
        name: str,
        *,
        body: str,
        mass: float,
        stiffness: float = ...,
        damping: float = ...,
        participation: _Numbers = ...,
        hydro: str = ...,
        initial: ModeInitial = ...,
    ) -> str:
        """Add `[[mode]]`.

        A shape in which a body deforms: a normal mode of the dry body, whose amplitude is a
        further coordinate.

        Parameters
        ----------
        name : text
            Name of the mode in the results.
        body : text
            Body that deforms.
        mass : number, kg
            Modal mass of the dry body, in the scale of its shape. Allowed: > 0.
        stiffness : number, N/m, default 0
            Modal stiffness of the structure. That of the water comes from the database.
            Allowed: >= 0.
        damping : number, N s/m, default 0
            Modal damping of the structure. Allowed: >= 0.
        participation : 3 numbers, kg, optional
            Participation factors of finite-element programs: the shape, summed over the mass of
            the body, along its axes. By these the weight loads the mode. Default: zero, as of
            normal modes of a free body.
        hydro : text, optional
            Name of this mode in the hydrodynamic database, without the body; default: the name.
        initial : dict, optional
            Start of the mode. Keys: amplitude [m], rate [m/s].

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def attachment(
        self,
        name: str,
        *,
        body: str,
        point: _Numbers,
        displacement: _Rows,
        rotation: _Rows = ...,
    ) -> str:
        """Add `[[attachment]]`.

        A place on a body that moves with the modes of that body. Joints, forces and markers
        name it as a body.

        Parameters
        ----------
        name : text
            Name of the attachment, and of the body that it is for others.
        body : text
            Body that deforms.
        point : 3 numbers, m
            Where it is in the reference pose, world axes.
        displacement : list of points, m/m
            Displacement of this point by each mode of the body: a vector of body axes for each
            mode, in their order in the case, per unit of amplitude.
        rotation : list of points, rad/m, optional
            Rotation there by each mode: a vector of body axes for each mode, per unit of
            amplitude; default: none.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    @property
    def joint(self) -> JointTypes:
        """A joint that carries body B on body A, or on the ground."""
    @property
    def constraint(self) -> ConstraintTypes:
        """A condition on coordinates of joints or bodies."""
    def marker(
        self,
        name: str,
        *,
        body: str,
        point: _Numbers,
        axes: _MarkerAxes = ...,
    ) -> str:
        """Add `[[marker]]`.

        A point of a body whose motion is reported.

        Parameters
        ----------
        name : text
            Name of the marker in the results.
        body : text
            Body that carries it.
        point : 3 numbers, m
            Where it is in the reference pose, world axes.
        axes : text, default "world"
            Axes of the velocity and acceleration that are reported: of the world, or carried by
            the body. The position is in world axes. Allowed: world, body.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    @property
    def force(self) -> ForceTypes:
        """What loads the bodies beside weight, water and joints."""
    def morison(
        self,
        name: str,
        *,
        body: str,
        point: _Numbers = ...,
        point_a: _Numbers = ...,
        point_b: _Numbers = ...,
        diameter: float = ...,
        area: float = ...,
        volume: float = ...,
        drag_coefficient: float = ...,
        drag_axial: float = ...,
        added_mass_coefficient: float = ...,
        added_mass_axial: float = ...,
        segments: int = ...,
        surface: _MorisonSurface = ...,
    ) -> str:
        """Add `[[morison]]`.

        Drag and inertia of the water on a point or on a slender member of a body (Morison).

        Parameters
        ----------
        name : text
            Name of this element in the results, as a force.
        body : text
            Body that carries it.
        point : 3 numbers, m, optional
            Where a point element is in the reference pose, world axes.
        point_a : 3 numbers, m, optional
            First end of a member in the reference pose, world axes.
        point_b : 3 numbers, m, optional
            Second end of a member in the reference pose, world axes.
        diameter : number, m, optional
            Diameter D of a member, or of a point element (a sphere). Allowed: > 0.
        area : number, m2, optional
            Drag area A of a point element without a diameter. Allowed: >= 0.
        volume : number, m3, optional
            Volume V of a point element without a diameter. Allowed: >= 0.
        drag_coefficient : number, default 0
            C_d: drag across a member (over D dl), or of a point element (over A). Allowed: >=
            0.
        drag_axial : number, default 0
            C_dt: drag along a member, over its wetted surface pi D dl. Allowed: >= 0.
        added_mass_coefficient : number, optional
            C_a, across a member; the inertia force is rho V (1 + C_a). Without this key there
            is no inertia force: right for a body whose database holds excitation and added
            mass. Allowed: >= 0.
        added_mass_axial : number, default 0
            C_at: added mass along a member. Allowed: >= 0.
        segments : integer, default 20
            Pieces of equal length into which a member is cut ; 20 by default. Allowed: 1 to
            1000.
        surface : text, default "mean"
            Up to which surface the element is wet: the mean one (as in linear theory), or the
            instantaneous one, where the water above z = 0 moves as at z = 0. Allowed: mean,
            instantaneous.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def chamber(
        self,
        name: str,
        *,
        volume: float,
        exponent: float = ...,
        pressure: float = ...,
    ) -> str:
        """Add `[[chamber]]`.

        Air between pistons and outlets: an air chamber, or a tank. Its pressure loads the
        pistons.

        Parameters
        ----------
        name : text
            Name of the chamber in the results.
        volume : number, m3
            Volume V0 of the air where all its pistons are at zero. At a scale of 1 : e it is
            that of the device over e^2, as the atmosphere has no scale. Allowed: > 0.
        exponent : number, default 1.4
            Exponent n of the air: 1.4 isentropic, 1 isothermal, between them polytropic.
            Allowed: 1 to 1.4.
        pressure : number, Pa, default 0
            Gauge pressure at the start.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def piston(
        self,
        name: str,
        *,
        chamber: str,
        area: float,
        joint: str = ...,
        coordinate: str = ...,
        mode: str = ...,
        roof: float = ...,
    ) -> str:
        """Add `[[piston]]`.

        A coordinate that presses the air of a chamber: of a joint, or the amplitude of a mode.

        Parameters
        ----------
        name : text
            Name of the piston.
        chamber : text
            Chamber whose air it presses.
        joint : text, optional
            Joint whose coordinate it is.
        coordinate : text, optional
            Which coordinate of the joint: displacement, angle, angle_2, ...; default: its only
            one.
        mode : text, optional
            Mode whose amplitude it is.
        area : number, m2 or m3/rad
            Area S by which it takes volume from the chamber; on a rotation times its lever. Of
            a mode the integral of its vertical shape over the water. Allowed: > 0.
        roof : number, m, optional
            Coordinate at which the water is at the roof: the run ends there. Default: where no
            air is left.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    @property
    def outlet(self) -> OutletTypes:
        """What lets air out of a chamber and in: an orifice, a plug, a turbine."""
    def gauge(
        self,
        name: str,
        *,
        point: _Numbers = ...,
        marker: str = ...,
        ahead: _Numbers = ...,
    ) -> str:
        """Add `[[gauge]]`.

        A place where the elevation of the undisturbed waves is reported, now and some time
        ahead.

        Parameters
        ----------
        name : text
            Name of the gauge in the results.
        point : list of numbers, m, optional
            Where it stands, [x, y]; the origin by default.
        marker : text, optional
            Marker above or beneath which it stays, in place of a point.
        ahead : list of numbers, s, optional
            Times from now to those whose elevation is reported, too: a forecast without error,
            as the waves are those of the run. Allowed: >= 0.

        Returns
        -------
        str
            The name, for other calls to refer to.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    @property
    def controller(self) -> ControllerTypes:
        """A sampled controller: it reads channels, and holds inputs between its instants."""
    def solver(
        self,
        *,
        end_time: float,
        method: _SolverMethod = ...,
        formulation: _SolverFormulation = ...,
        start: _SolverStart = ...,
        rtol: float = ...,
        step: float = ...,
        max_step: float = ...,
        max_order: int = ...,
        order: int = ...,
        spectral_radius: float = ...,
        baumgarte_time: float = ...,
        energy_guard: float = ...,
        branch_guard: bool = ...,
        accuracy: _SolverAccuracy = ...,
        tolerance_assembly: float = ...,
        force: bool = ...,
        length_scale: float = ...,
        time_scale: float = ...,
    ) -> None:
        """Add `[solver]`.

        Which method integrates the scene, how exactly, and what ends a run that goes wrong.

        Parameters
        ----------
        method : text, default "auto"
            Integrator: BDF (ida), implicit Runge-Kutta (radau, gauss, lobatto_iiic),
            generalised alpha on the Lie group, or projected explicit Runge-Kutta; auto:
            explicit_rk, radau or ida as suits the scene, and another of them where one cannot
            continue. Allowed: auto, radau, explicit_rk, ida, generalized_alpha, gauss,
            lobatto_iiic.
        formulation : text, default "stabilised"
            Equations of the constraints: stabilised index 2 (Gear, Gupta, Leimkuhler), plain
            index 2, index 3, or index 1; the last three for comparisons. Allowed: stabilised,
            index_2, index_3, index_1.
        start : text, default "given"
            Start from the given pose, or at rest from the static equilibrium in still water
            near it. Allowed: given, equilibrium.
        end_time : number, s
            End of the run. Allowed: > 0.
        rtol : number, default 1e-06
            Local error tolerance relative to the scales of the scene (see length_scale,
            time_scale); with a fixed step it bounds Newton iterations and events only. Allowed:
            1e-13 to 0.1.
        step : number, s, default 0
            Fixed step; 0: the method chooses. Needed by gauss, lobatto_iiic and
            generalized_alpha. Allowed: >= 0.
        max_step : number, s, default 0
            Longest step; 0: no limit. Allowed: >= 0.
        max_order : integer, default 5
            Highest order of the BDF method. Allowed: 1 to 5.
        order : integer, default 0
            Order of a Runge-Kutta method: radau 1, 3, .. 19, gauss 2, 4, .. 20, lobatto_iiic 2,
            4, .. 18, explicit_rk 5 or 8; 0: radau chooses among 5, 9 and 13, gauss takes 6,
            lobatto_iiic 4, explicit_rk 8. Allowed: 0 to 20.
        spectral_radius : number, default 0.8
            Of generalized_alpha for infinitely fast modes: 1 no damping, 0 most. Allowed: 0 to
            1.
        baumgarte_time : number, s, default 0
            Time in which index 1 takes back a gap (Baumgarte); 0: never. Allowed: >= 0.
        energy_guard : number, optional
            A run ends as failed when the energy balance is off by more than this part of the
            energy exchanged; 0: no guard. By default 0.01; at a singular pose of a closed loop
            0.01 sqrt(rtol), at least 1e-5, or 5e-4 with fixed steps. Mechanisms that drives
            guide altogether may miss ten times as much, since their reactions take and give it.
            Allowed: >= 0.
        branch_guard : true or false, default true
            A run of a scene with closed loops ends as failed when its velocities jump though
            nothing strikes: at a singular pose the motion left its branch.
        accuracy : text, default "two_runs"
            Estimate of the error of the motion, body by body: two_runs compares the run with a
            second one at 10 rtol, or at twice the fixed step, which runs in a second thread;
            none: no estimate. Allowed: two_runs, none.
        tolerance_assembly : number, default 1e-06
            Allowed misalignment of joints, as part of the body's lever (its farthest joint or
            radius of gyration), or of one radian. Below it joints count as exact, and rows that
            follow from others are left out. Above it they would lock the mechanism and are
            refused. Allowed: 1e-12 to 0.1.
        force : true or false, default false
            Run what is known to fail, for comparisons: a pair of method and formulation,
            radiation that is not passive, joints that are out of line with each other.
        length_scale : number, m, optional
            Length that the tolerance of positions refers to; default: from the bodies and
            joints. Allowed: 1e-12 to 1e+12.
        time_scale : number, s, optional
            Time that turns the position scale into the velocity scale; default: from gravity,
            else from the start. Allowed: 1e-12 to 1e+12.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
    def output(
        self,
        *,
        step: float = ...,
    ) -> None:
        """Add `[output]`.

        What the results file holds.

        Parameters
        ----------
        step : number, s, default 0.1
            Time between two samples of the results. Allowed: > 0.

        Raises
        ------
        CaseError
            A key or a value is wrong.
        """
