"""The page of `hydrodae view` in a headless browser; skipped where there is none."""

from __future__ import annotations

from io import BytesIO
from pathlib import Path

import numpy as np
import pytest
from matplotlib.image import imread

import hydrodae
from hydrodae.viewer import ViewError, browser
from hydrodae.viewer.viewing import View

SIZE = (480, 300)


@pytest.fixture(scope="module")
def seen(repository, tmp_path_factory) -> View:
    """A flap's two seconds in an irregular sea, its lines and joints."""
    output = tmp_path_factory.mktemp("browser") / "f3of.h5"
    case = repository / "cases" / "f3of" / "waves.toml"
    values = {"solver.end_time": 2.0, "sea.ramp": 0.5}
    return hydrodae.view(hydrodae.run(case, output, set=values))


@pytest.fixture(scope="module")
def page(seen):
    """The open page."""
    pytest.importorskip("playwright", reason="needs the extra view")
    try:
        opened = browser.opened(seen.html(), SIZE)
        found = opened.__enter__()
    except ViewError as error:
        pytest.skip(f"needs a browser: {error}")
    yield found
    opened.__exit__(None, None, None)


def test_bodies_are_between_their_samples(page, seen):
    page.evaluate("hydrodae.show(1.25)")
    for body in seen.stage.bodies:
        expected = 0.5 * (body.position[12] + body.position[13])
        assert page.evaluate("name => hydrodae.place(name)", body.name) == pytest.approx(
            expected.tolist(), abs=1e-5
        )


def test_the_sea_is_that_of_the_run(page, seen):
    for t, x, y in [(0.3, 0.0, 0.0), (2.0, -7.0, 3.0), (1.1, 30.0, -20.0)]:
        mine = float(seen.stage.sea.elevation(t, np.array([x]), np.array([y]))[0])
        there = page.evaluate("at => hydrodae.elevation(...at)", [t, x, y])
        assert there == pytest.approx(mine, abs=2e-4)


def test_picking_a_body_shows_its_curves(page):
    page.evaluate("hydrodae.pick('flap1')")
    assert page.inner_text("#panel h2") == "flap1"
    titles = page.locator("#charts .u-title").all_inner_texts()
    assert "rotation [deg]" in titles
    assert "hinge1: angle [deg]" in titles
    page.keyboard.press("Escape")
    assert page.is_hidden("#panel")


def test_it_plays_and_pauses(page):
    page.evaluate("hydrodae.show(0)")
    page.click("#play")
    page.wait_for_function("hydrodae.player.time > 0")
    page.click("#play")
    stopped = page.evaluate("hydrodae.player.time")
    page.wait_for_timeout(100)
    assert page.evaluate("hydrodae.player.time") == stopped
    page.keyboard.press("ArrowLeft")
    assert page.evaluate("hydrodae.player.time") < stopped


def test_what_is_left_out_while_it_plays_hardly_shows(page):
    """Light at corners alone, then coarser water and no edges: nothing may vanish."""
    pictures = []
    for level in range(3):
        page.evaluate("level => hydrodae.show(1, level)", level)
        pictures.append(imread(BytesIO(page.screenshot()))[..., :3])
    page.evaluate("hydrodae.show(1)")
    full, *fewer = pictures
    for picture in fewer:
        difference = abs(picture - full).mean(axis=2)
        assert 0.0 < difference.mean() < 0.03
        assert (difference > 0.2).mean() < 0.02


@pytest.mark.parametrize("name", ["side", "top"])
def test_the_camera_goes_round(page, name):
    before = page.inner_html("#axes")
    page.get_by_text(name, exact=True).click()
    page.evaluate("hydrodae.show(1)")
    assert page.inner_html("#axes") != before


def test_picture_and_video_are_drawn(page, seen, tmp_path: Path):
    pytest.importorskip("imageio_ffmpeg", reason="needs the extra view")
    picture = seen.picture(tmp_path / "a.png", time=1.0, size=SIZE)
    pixels = imread(picture)
    assert pixels.shape[:2] == (450, 720)
    # sky, water and an orange flap
    assert np.ptp(pixels[..., :3].reshape(-1, 3), axis=0).min() > 0.3
    video = seen.video(tmp_path / "a.gif", size=SIZE, rate=2.0)
    assert video.read_bytes()[:6] == b"GIF89a"


def test_everything_fits_a_narrow_screen(page):
    page.set_viewport_size({"width": 390, "height": 844})
    page.evaluate("hydrodae.pick('flap1')")
    for name in ("#views", "#switches", "#player", "#speed", "#panel", ".chart canvas"):
        box = page.locator(name).first.bounding_box()
        assert box is not None
        assert box["x"] >= 0.0, name
        assert box["x"] + box["width"] <= 390.0, name
    page.keyboard.press("Escape")
    page.set_viewport_size({"width": SIZE[0], "height": SIZE[1]})
