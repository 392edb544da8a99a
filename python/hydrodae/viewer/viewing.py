"""The function `hydrodae.view` and what it returns."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hydrodae.case.case import CaseLike
from hydrodae.errors import CaseError
from hydrodae.results import Results
from hydrodae.viewer import browser
from hydrodae.viewer.framing import Frame, camera_of, frame_of
from hydrodae.viewer.page import page_text, write_page
from hydrodae.viewer.paraview import write_paraview
from hydrodae.viewer.source import open_source
from hydrodae.viewer.stage import Stage
from hydrodae.viewer.staging import make_stage

PathLike = str | os.PathLike[str]


@dataclass(frozen=True)
class View:
    """A scene over time, as it can be drawn.

    Attributes
    ----------
    stage : hydrodae.viewer.stage.Stage
        Bodies, joints, lines and sea over time.
    frame : hydrodae.viewer.framing.Frame
        What is shown.
    camera : (azimuth, elevation, zoom)
        From where [deg].
    """

    stage: Stage
    frame: Frame
    camera: tuple[float, float, float]

    @property
    def opening(self) -> float:
        """First sample at which the waves have grown, the last one if they have not [s]."""
        sea, time = self.stage.sea, self.stage.time
        if sea is None or not len(sea.waves):
            return float(time[0])
        return float(time[min(int(np.searchsorted(time, sea.ramp)), len(time) - 1)])

    def html(self, time: float | None = None) -> str:
        """Return the page: one HTML file that needs neither network nor server.

        Parameters
        ----------
        time : float, optional
            At which it opens [s]; by default `opening`.

        Raises
        ------
        CaseError
            The time is outside of the samples.
        """
        begin = self.opening if time is None else self._inside(time)
        return page_text(self.stage, self.frame, self.camera, begin)

    def write(self, path: PathLike, *, time: float | None = None) -> Path:
        """Write the page.

        Parameters
        ----------
        path : path
            Ends in .html.
        time : float, optional
            At which it opens [s]; by default `opening`.

        Raises
        ------
        CaseError
            The name does not end in .html, or the time is outside of the samples.
        """
        target = Path(path)
        if target.suffix.lower() not in (".html", ".htm"):
            raise CaseError(f"{target}: a page needs a name that ends in .html")
        return write_page(self.html(time), target)

    def picture(
        self, path: PathLike, *, time: float | None = None, size: tuple[int, int] = (1280, 720)
    ) -> Path:
        """Draw a picture without a screen.

        Parameters
        ----------
        path : path
            Ends in .png or .jpg.
        time : float, optional
            When [s]; by default the middle of the samples.
        size : (width, height)
            Of the page in pixels; the picture has 1.5 times as many each way.

        Raises
        ------
        CaseError
            The time is outside of the samples.
        ViewError
            Playwright (extra `view`) or a browser is missing.
        """
        start, end = float(self.stage.time[0]), float(self.stage.time[-1])
        at = 0.5 * (start + end) if time is None else self._inside(time)
        return browser.picture(self.html(), Path(path), at, size)

    def _inside(self, time: float) -> float:
        start, end = float(self.stage.time[0]), float(self.stage.time[-1])
        if not start <= time <= end:
            raise CaseError(f"time {time:g} s: the samples are from {start:g} to {end:g} s")
        return time

    def video(
        self,
        path: PathLike,
        *,
        size: tuple[int, int] = (1280, 720),
        rate: float = 25.0,
        speed: float = 1.0,
        progress: Callable[[int, int], None] | None = None,
    ) -> Path:
        """Draw a video without a screen.

        Parameters
        ----------
        path : path
            Ends in .mp4, .webm or .gif.
        size : (width, height)
            In pixels.
        rate : float
            Frames a second.
        speed : float
            Simulated over shown time.
        progress : callable, optional
            Called with (done, of) after each frame.

        Raises
        ------
        CaseError
            There is only one sample, or rate or speed is not > 0.
        ViewError
            Playwright (extra `view`), a browser or ffmpeg is missing.
        """
        start, end = float(self.stage.time[0]), float(self.stage.time[-1])
        if not end > start:
            raise CaseError("a video needs results of a run: there is only one sample")
        if not (rate > 0.0 and speed > 0.0):
            raise CaseError("frames a second and speed must be > 0")
        count = int((end - start) / speed * rate + 1e-9) + 1
        times = (start + np.arange(count) * speed / rate).tolist()
        return browser.video(self.html(), Path(path), times, size, rate, progress)

    def paraview(self, folder: PathLike) -> list[Path]:
        """Write files for ParaView into a folder; see `hydrodae.viewer.paraview`."""
        return write_paraview(self.stage, self.frame, Path(folder))


def view(
    results: Results | CaseLike,
    *,
    case: CaseLike | None = None,
    first: float = -np.inf,
    last: float = np.inf,
    step: float | None = None,
    shapes: Mapping[str, str] | None = None,
    freeboard: float | None = None,
    channels: Sequence[str] = (),
    camera: str = "oblique",
) -> View:
    """See results in three dimensions: bodies, joints, lines and the sea of the run.

    Parameters
    ----------
    results : Results or path, or Case, Scene or path of a case file
        A case is seen at its start, without a run.
    case : Case, Scene or path, optional
        Case of the results, where its files are no longer where the results say.
    first, last : float
        Samples to take [s].
    step : float, optional
        Least time between two samples [s]; by default such that there are at most 4000.
    shapes : mapping from str to str, optional
        Shapes of bodies, in the reference pose, in place of their wetted surface or of what is
        guessed: ``"cylinder:radius=3:length=30:z=-4"`` (along z), ``"sphere:radius=5"``,
        ``"box:length=2:width=1:height=1"``, about the centre of gravity and moved by x, y, z;
        ``"rods:diameter=0.2"`` to what is attached; or a mesh file.
    freeboard : float, optional
        Height above water up to which wetted surfaces are drawn [m]; by default 0.15 of the
        draught. 0: they end at the water line, as in the database.
    channels : sequence of str
        Patterns of channels to be shown as curves beside the usual ones.
    camera : str
        oblique, side, front, top, all (where lines reach far), or "AZIMUTH,ELEVATION[,ZOOM]" [deg].

    Returns
    -------
    View
        Its `write`, `picture`, `video` and `paraview` make files.

    Raises
    ------
    CaseError
        The case of the results cannot be read, or a shape, channel or camera is wrong.
    ResultsError
        The results cannot be used.
    DatabaseError
        The hydrodynamic database cannot be read.

    Examples
    --------
    >>> import hydrodae
    >>> seen = hydrodae.view("cases/f3of/waves.toml")  # doctest: +SKIP
    >>> seen.write("f3of.html")  # doctest: +SKIP
    """
    if step is not None and not step > 0.0:
        raise CaseError(f"step: expected a time > 0 s between samples, got {step:g}")
    if freeboard is not None and not 0.0 <= freeboard < np.inf:
        raise CaseError(f"freeboard: expected a height >= 0 m, got {freeboard:g}")
    source = open_source(results, case, first=first, last=last)
    stage = make_stage(source, shapes=shapes, height=freeboard, channels=channels, step=step)
    frame = frame_of(stage)
    return View(stage, frame, camera_of(camera, frame))
