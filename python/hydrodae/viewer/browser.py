"""Pictures and videos without a screen: the page in a headless browser (extra `view`)."""

from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

from hydrodae.errors import HydrodaeError
from hydrodae.support import outputs
from hydrodae.support.extras import install_command

#: Environment variable with the browser to take.
BROWSER = "HYDRODAE_BROWSER"
#: Names under which systems have a browser that playwright can drive.
NAMES = (
    *("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome"),
    "chromium-headless-shell",  # of Debian
)
#: Range and sampling of colours that players expect.
TELEVISION = "scale=out_range=tv,format=yuv420p"
#: Flags of ffmpeg by the ending of a video.
ENCODERS = {
    ".mp4": ["-c:v", "libx264", "-vf", TELEVISION, "-crf", "20", "-movflags", "+faststart"],
    ".webm": ["-c:v", "libvpx-vp9", "-vf", TELEVISION, "-crf", "30", "-b:v", "0"],
    ".gif": ["-vf", "split[a][b];[a]palettegen[p];[b][p]paletteuse=dither=bayer"],
}
PICTURES = (".png", ".jpg", ".jpeg")


class ViewError(HydrodaeError):
    """A picture or video cannot be made."""


@contextmanager
def opened(text: str, size: tuple[int, int], sharp: float = 1.0) -> Iterator[Any]:
    """Open a page in a headless browser.

    Parameters
    ----------
    text : str
        The HTML.
    size : (width, height)
        In pixels of the page.
    sharp : float
        Pixels of the picture over those of the page.

    Yields
    ------
    playwright.sync_api.Page

    Raises
    ------
    ViewError
        Playwright or a browser is missing, or the page cannot be drawn.
    """
    try:
        from playwright.sync_api import Error, sync_playwright
    except ImportError as error:
        raise ViewError(
            f"pictures and videos need playwright: {install_command('view')}"
        ) from error
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "view.html"
        file.write_text(text, encoding="utf-8")
        try:
            with sync_playwright() as playwright:
                program = executable(playwright.chromium.executable_path)
                browser = playwright.chromium.launch(executable_path=program, args=_flags())
                page = browser.new_page(
                    viewport={"width": size[0], "height": size[1]},
                    device_scale_factor=sharp,
                    locale="en-US",  # that of the POSIX environment is no language to JavaScript
                )
                _load(page, file)
                yield page
                browser.close()
        except Error as error:
            raise ViewError(f"the browser failed: {error.message}") from error


def _load(page: Any, file: Path) -> None:
    errors: list[str] = []
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.goto(file.as_uri())
    if errors or not page.evaluate("Boolean(window.hydrodae)"):
        raise ViewError(f"the page cannot be drawn: {'; '.join(errors) or 'no reason given'}")


def _apart(call: Callable[[], None]) -> None:
    """Call in a thread of its own: a notebook's has a loop, in which playwright does not work."""
    with ThreadPoolExecutor(1) as pool:
        pool.submit(call).result()


def executable(own: str) -> str:
    """Return the browser to take: $HYDRODAE_BROWSER, playwright's own one, or the system's.

    Parameters
    ----------
    own : str
        Where playwright keeps its browser once it is installed.

    Raises
    ------
    ViewError
        There is none.
    """
    named = os.environ.get(BROWSER)
    if named:
        found = shutil.which(named)
        if found is None:
            raise ViewError(f"{BROWSER} = {named!r} is no program")
        return found
    if Path(own).is_file():
        return own
    for name in NAMES:
        found = shutil.which(name)
        if found is not None:
            return found
    raise ViewError(
        "no browser: run 'playwright install chromium', or name a Chromium or Chrome of yours "
        f"in the environment variable {BROWSER}"
    )


def _flags() -> list[str]:
    """WebGL by the processor; the sandbox does not work for root."""
    flags = ["--enable-unsafe-swiftshader"]
    return flags + (["--no-sandbox"] if os.geteuid() == 0 else [])


def picture(text: str, path: Path, time: float, size: tuple[int, int]) -> Path:
    """Draw a page at a time [s] into a PNG or JPEG file.

    Raises
    ------
    ViewError
        Another ending, or as `opened`.
    """
    if path.suffix.lower() not in PICTURES:
        raise ViewError(f"{path}: no such kind of picture; known are {', '.join(PICTURES)}")
    outputs.claim(path, outputs.PICTURE)

    def draw() -> None:
        with opened(text, size, sharp=1.5) as page:
            page.evaluate("hydrodae.hideControls()")
            page.evaluate("time => hydrodae.show(time)", time)
            page.screenshot(path=path)

    _apart(draw)
    return path


def video(
    text: str,
    path: Path,
    times: list[float],
    size: tuple[int, int],
    rate: float,
    progress: Callable[[int, int], None] | None = None,
) -> Path:
    """Draw a page at many times [s] into a video of `rate` frames a second.

    Raises
    ------
    ViewError
        Another ending than mp4, webm or gif, ffmpeg is missing or fails, or as `opened`.
    """
    flags = ENCODERS.get(path.suffix.lower())
    if flags is None:
        raise ViewError(f"{path}: no such kind of video; known are {', '.join(ENCODERS)}")
    ffmpeg = find_ffmpeg()
    outputs.claim(path, outputs.VIDEO)
    even = (size[0] // 2 * 2, size[1] // 2 * 2)  # the coding of colours takes pairs of pixels
    command = [ffmpeg, "-y", "-loglevel", "error", "-f", "image2pipe", "-c:v", "mjpeg"]
    command += ["-framerate", f"{rate:g}", "-i", "-", *flags, str(path)]

    def draw() -> None:
        with opened(text, even) as page:
            page.evaluate("hydrodae.hideControls()")
            page.evaluate("hydrodae.sharpen(1)")
            frames = _frames(page, times, progress)
            _encode(command, frames, path)

    _apart(draw)
    return path


def _frames(
    page: Any, times: list[float], progress: Callable[[int, int], None] | None
) -> Iterator[bytes]:
    for i, time in enumerate(times):
        page.evaluate("time => hydrodae.show(time)", time)
        yield page.screenshot(type="jpeg", quality=92)
        if progress is not None:
            progress(i + 1, len(times))


def _encode(command: list[str], frames: Iterator[bytes], path: Path) -> None:
    with (
        tempfile.TemporaryFile() as said,
        subprocess.Popen(command, stdin=subprocess.PIPE, stderr=said) as encoder,
    ):
        assert encoder.stdin is not None
        with suppress(BrokenPipeError):  # ffmpeg has ended: its code and words show why
            for frame in frames:
                encoder.stdin.write(frame)
            encoder.stdin.close()
        encoder.wait()
        if encoder.returncode:
            said.seek(0)
            raise ViewError(f"{path}: ffmpeg failed: {said.read().decode(errors='replace')}")


def find_ffmpeg() -> str:
    """Return the ffmpeg of the system, or that of the extra.

    Raises
    ------
    ViewError
        There is none.
    """
    found = shutil.which("ffmpeg")
    if found is not None:
        return found
    try:
        from imageio_ffmpeg import get_ffmpeg_exe
    except ImportError as error:
        raise ViewError(
            f"a video needs ffmpeg: install it, or {install_command('view')}"
        ) from error
    return str(get_ffmpeg_exe())
