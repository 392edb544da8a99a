"""Powers of a take-off stage by stage, as results of a study."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from hydrodae.case.case import to_toml
from hydrodae.wecsim.text import CaseText

#: Name of the study beside the case.
POWERS = "powers.toml"

Term = dict[str, Any]


def term(channel: str, factor: float = 1.0, power: int = 1) -> Term:
    """A term of a power: factor times a channel, or its square."""
    out: Term = {"channel": channel}
    if factor != 1.0:
        out["factor"] = float(f"{factor:.12g}")
    if power != 1:
        out["power"] = power
    return out


@dataclass
class Stages:
    """Terms of the power at each stage [W]; empty where a take-off does not have it."""

    absorbed: list[Term]
    hydraulic: list[Term]
    shaft: list[Term]
    electric: list[Term]

    def __add__(self, other: Stages) -> Stages:
        return Stages(
            self.absorbed + other.absorbed,
            self.hydraulic + other.hydraulic,
            self.shaft + other.shaft,
            self.electric + other.electric,
        )

    def write(self, folder: Path, end_time: float) -> None:
        """Write a study with the mean of each stage and the efficiency from first to last."""
        text = CaseText()
        text.comment("Mean power at each stage of the take-offs, from the end of the ramp on [W].")
        text.value("case", "case.toml")
        text.table("[list]", {})
        text.lines.append(f'"solver.end_time" = [{to_toml(end_time, "end_time")}]')
        last = ""
        for name in ("absorbed", "hydraulic", "shaft", "electric"):
            terms = getattr(self, name)
            if terms:
                text.table(f"[result.power_{name}]", {"terms": terms, "unit": "W"})
                last = name
        if last != "absorbed":
            keys = {"terms": getattr(self, last), "unit": "W", "over": "power_absorbed"}
            text.table("[result.efficiency]", keys)
        (folder / POWERS).write_text(str(text), encoding="utf-8")
