"""Frames a second of a page of `hydrodae view`, and the processor time that each takes.

    python tests/benchmark/view_frames.py PAGE.html [SECONDS]

The page plays in a headless browser without a graphics card (extra `view`), which is a lower bound:
WebGL is then drawn by the processor. On a busy machine the processor time tells more.
"""

from __future__ import annotations

import argparse
import os
import sys
import time
from pathlib import Path

from hydrodae.commands.cli import guarded
from hydrodae.viewer import browser

SIZE = (1280, 720)
COUNT = """seconds => new Promise(done => {
  let frames = 0, start;
  const count = now => {
    if (start === undefined) start = now;
    else ++frames;
    if (now - start > 1000 * seconds)
      done([frames, (now - start) / 1000, hydrodae.resolution(), hydrodae.leftOut()]);
    else requestAnimationFrame(count);
  };
  requestAnimationFrame(count);
})"""


def processor_time() -> float:
    """User and system time [s] of all processes under this one (Linux)."""
    parents, spent = {}, {}
    for folder in Path("/proc").iterdir():
        if folder.name.isdigit():
            try:
                fields = (folder / "stat").read_text().rpartition(")")[2].split()
            except OSError:
                continue  # it has ended
            parents[int(folder.name)] = int(fields[1])
            spent[int(folder.name)] = (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
    mine, more = set[int](), {os.getpid()}
    while more:
        more = {child for child, parent in parents.items() if parent in more}
        mine |= more
    return sum(spent[process] for process in mine)


def main() -> None:
    """Print one line."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("page", type=Path, metavar="PAGE.html")
    parser.add_argument("seconds", nargs="?", type=float, default=10.0)
    options = parser.parse_args()
    page_file, seconds = options.page, options.seconds
    with browser.opened(page_file.read_text(encoding="utf-8"), SIZE) as page:
        page.evaluate("hydrodae.player.toggle(true)")
        time.sleep(5.0)  # it finds its resolution
        before = processor_time()
        frames, passed, ratio, left_out = page.evaluate(COUNT, seconds)
        spent = processor_time() - before
    megabytes, milliseconds = page_file.stat().st_size / 1e6, 1000.0 * spent / frames
    print(
        f"{page_file.name}: {megabytes:.2f} MB, {frames / passed:.1f} frames a second at "
        f"{ratio:.2f} of the {SIZE[0]} x {SIZE[1]} pixels, {left_out} of 2 details left out; "
        f"{milliseconds:.0f} ms of processor time a frame"
    )


if __name__ == "__main__":
    sys.exit(guarded(main))
