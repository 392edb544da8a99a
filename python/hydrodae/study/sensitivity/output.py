"""What `hydrodae.sensitivity` found, as text, JSON and a picture."""

from __future__ import annotations

import json
import os
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from hydrodae.study.sensitivity.measure import Row
from hydrodae.support import outputs


def table(title: str, rows: Sequence[Row]) -> str:
    """Return the rows as text, one block for each result."""
    lines = [title]
    for result in dict.fromkeys(row.result for row in rows):
        lines.append(f"\n{result}")
        for row in rows:
            if row.result == result:
                known = not np.isnan(row.value)
                value = f"{row.value:12.6g} {row.change:+9.3f} %" if known else f"{'-':>12}"
                lines.append(f"  {row.variant:32} {value}")
    return "\n".join(lines)


def write(name: str | os.PathLike[str], title: str, rows: Sequence[Row]) -> list[Path]:
    """Write the rows as NAME.json and draw their changes as NAME.png."""
    base = Path(name)
    data = base.with_suffix(".json")
    entries = [
        {k: None if isinstance(v, float) and np.isnan(v) else v for k, v in asdict(row).items()}
        for row in rows
    ]
    picture = outputs.claim(base.with_suffix(".png"), outputs.PICTURE)
    text = json.dumps({"case": title, "rows": entries}, indent=1) + "\n"
    outputs.write_text(outputs.claim(data, outputs.JSON), text)
    names = list(dict.fromkeys(row.variant for row in rows))[1:]
    results = list(dict.fromkeys(row.result for row in rows))
    figure = Figure(figsize=(8.0, 1.5 + 0.3 * len(names)), layout="constrained")
    axes = figure.add_subplot()
    for result in results:
        change = {row.variant: row.change for row in rows if row.result == result}
        axes.plot([change[name] for name in names], range(len(names)), "o", label=result)
    axes.set_yticks(range(len(names)), names)
    axes.invert_yaxis()
    axes.set_xscale("symlog", linthresh=0.1)
    axes.axvline(0.0, color="0.5", linewidth=0.8)
    axes.set_xlabel("change against the tables as stored, %")
    axes.set_title(title)
    axes.grid(alpha=0.3)
    figure.legend(loc="outside lower center", ncols=2, fontsize="small")
    with outputs.whole(picture) as beside:
        figure.savefig(beside, dpi=120)
    return [data, picture]
