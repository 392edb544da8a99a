"""A cart that an FMU controls, and the same controller of the kernel."""

from __future__ import annotations

from pathlib import Path

from tests import scenes

from hydrodae import Case

PI = """
[[controller]]
name = "pi"
inputs = ["joints/slide/displacement_rate"]
outputs = ["forces/pto/load"]
period = 0.1
KEYS"""
CART = scenes.cart("stiffness = 8.0", more=PI)
OWN = 'type = "pid"\ngain_p = 1.3\ngain_i = 0.7'
FMU = """type = "fmu"
file = "pi.fmu"
fmu_inputs = ["rate"]
fmu_outputs = ["load"]
parameters = ["kp", "ki"]
parameter_values = [1.3, 0.7]"""
CHANNELS = ("joints/slide/displacement", "forces/pto/force", "controllers/pi/output")


def cart(folder: Path, keys: str = FMU) -> Case:
    (folder / "case.toml").write_text(CART.replace("KEYS", keys))
    return Case.read(folder / "case.toml")
