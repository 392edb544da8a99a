"""Pieces of an HTML page that needs no other file."""

from __future__ import annotations

import base64
import io
from collections.abc import Iterable, Sequence
from html import escape as escape
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: Vector pictures larger than this are drawn as pixels, bytes.
LARGEST_VECTOR = 3_000_000

_STYLE = """
body { font: 15px/1.45 system-ui, sans-serif; color: #222; max-width: 64rem; margin: 2rem auto;
  padding: 0 1rem; }
h1 { font-size: 1.6rem; } h2 { font-size: 1.2rem; margin-top: 2.2rem;
  border-bottom: 1px solid #ddd; }
table { border-collapse: collapse; margin: .6rem 0; display: block; overflow-x: auto; }
td, th { padding: .2rem .7rem; border-bottom: 1px solid #eee; text-align: left;
  vertical-align: top; }
td.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
pre { background: #f6f6f6; padding: .8rem; white-space: pre-wrap; overflow-wrap: anywhere;
  font-size: 13px; }
img { max-width: 100%; } .failed { color: #b00020; font-weight: 600; }
"""


def page(title: str, parts: Iterable[str]) -> str:
    """Return the whole page."""
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f"<title>{escape(title)}</title>\n<style>{_STYLE}</style>\n</head>\n<body>\n"
        f"<h1>{escape(title)}</h1>\n" + "\n".join(parts) + "\n</body>\n</html>\n"
    )


def section(title: str, *parts: str) -> str:
    """Return a part of the page with a heading; nothing without content."""
    inside = "\n".join(part for part in parts if part)
    return f"<section>\n<h2>{escape(title)}</h2>\n{inside}\n</section>" if inside else ""


def paragraph(text: str, kind: str = "") -> str:
    """Return a paragraph."""
    return f"<p{_class(kind)}>{escape(text)}</p>"


def text_block(text: str) -> str:
    """Return lines as they stand."""
    return f"<pre>{escape(text)}</pre>" if text.strip() else ""


def folded(title: str, text: str) -> str:
    """Return lines that a reader unfolds."""
    return f"<details><summary>{escape(title)}</summary>{text_block(text)}</details>"


def table(head: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """Return a table; numbers stand to the right. Nothing without rows."""
    lines = ["<tr>" + "".join(_cell(value) for value in row) + "</tr>" for row in rows]
    if not lines:
        return ""
    titles = "".join(f"<th>{escape(word)}</th>" for word in head)
    return "<table>\n" + (f"<tr>{titles}</tr>\n" * bool(head)) + "\n".join(lines) + "\n</table>"


def picture(figure: Figure, alt: str) -> str:
    """Return a figure inside the page: as vectors, or as pixels if these are too many."""
    data, kind = _drawn(figure, "svg"), "svg+xml"
    if len(data) > LARGEST_VECTOR:
        data, kind = _drawn(figure, "png"), "png"
    code = base64.b64encode(data).decode()
    return f'<img alt="{escape(alt, quote=True)}" src="data:image/{kind};base64,{code}">'


def _drawn(figure: Figure, kind: str) -> bytes:
    stream = io.BytesIO()
    figure.savefig(stream, format=kind)
    return stream.getvalue()


def _cell(value: object) -> str:
    if isinstance(value, float):
        return f'<td class="number">{value:,.5g}</td>'
    if isinstance(value, int):
        return f'<td class="number">{value:,}</td>'
    return f"<td>{escape(str(value))}</td>"


def _class(kind: str) -> str:
    return f' class="{kind}"' if kind else ""
