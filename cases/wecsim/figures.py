"""The figure of an example beside the stored value of WEC-Sim or a closed form."""

from __future__ import annotations

import math
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import imported_sea  # type: ignore[import-not-found] # stands beside this file
import numpy as np
import passive_yaw  # type: ignore[import-not-found] # stands beside this file
import predictive  # type: ignore[import-not-found] # stands beside this file
import ptosim  # type: ignore[import-not-found] # stands beside this file
from of_case import (  # type: ignore[import-not-found] # stands beside this file
    Figure,
    NoFigure,
    amplitude,
    database_of,
    heave_of,
    heave_tables,
    tables_of,
    time_of,
    waterplane_of,
)
from scipy.io import loadmat

import hydrodae
from hydrodae.case.contents import case_tables
from hydrodae.results import Results
from hydrodae.study.sweep.measures import make_measure, measure


def make(example: dict[str, Any], results: Results, case: Path, folder: Path) -> Figure | None:
    """The figure that `examples.json` asks for by `figure`.

    Parameters
    ----------
    example : dict
        Entry of the example.
    results : Results
        Of its run.
    case : Path
        Converted case file.
    folder : Path
        Folder of the example in the clone.
    """
    kind = example.get("figure", "")
    if kind == "stored":
        return stored(results, case, folder / example["file"])
    if kind == "drift":
        return drift(results, case, folder.parent / "WAMIT" / "outputFiles" / "sphere.7")
    if kind == "stages":
        return stages(results, case, folder, example["stage"])
    if kind == "elevation":
        ours, exact = imported_sea.elevations(case, folder / example["file"])
        means = float(np.mean(ours * exact)), float(np.mean(exact**2))
        name = "elevation, square mean against that of the file, m2"
        return Figure(name, *means, "its spectrum and phases")
    if kind == "modes":
        return modes(results, case, folder / example["file"])
    if kind == "predictive":
        found = predictive.figures(case, folder, seeds=10)["power"]
        name = "mean power of ten seas with `predictive.py`, W"
        return Figure(name, found, 3.0e5, "manual of WEC-Sim, one sea")
    if kind == "":
        return None
    tables = tables_of(case)
    if kind in ("heave", "reactive") and "period" not in tables.get("wave", [{}])[0]:
        raise NoFigure("there is no regular wave")
    return {
        "heave": heave,
        "reactive": reactive,
        "decay": decay,
        "morison": morison,
        "power": power,
        "control": control,
        "conditions": conditions,
        "gauges": gauges,
        "orifice": orifice,
        "turbine": turbine,
        "yaw": yaw,
        "faced": faced,
        "pitch": pitch,
    }[kind](results, case)


def modes(results: Results, case: Path, file: Path) -> Figure:
    """Amplitude of the first mode in a regular wave, and that of WAMIT's `.4` file."""
    tables = tables_of(case)
    wave, (body, name) = tables["wave"][0], (tables["mode"][0][key] for key in ("body", "name"))
    period, height = wave["period"], wave["height"]
    channel = np.asarray(results[f"modes/{body}.{name}/amplitude"]).ravel()
    ours = amplitude(time_of(results), channel, 2.0 * math.pi / period)
    rows = np.loadtxt(file, skiprows=1)
    rows = rows[rows[:, 2] == float(name.removeprefix("mode"))]
    exact = 0.5 * height * float(np.interp(period, rows[:, 0], rows[:, 3]))
    return Figure(f"amplitude of {name}, m", ours, exact, f"WAMIT, {file.name}")


def stored(results: Results, case: Path, file: Path) -> Figure:
    """Heave of the first body against the second at the end of the run, and that of WEC-Sim."""
    bodies = loadmat(file, simplify_cells=True)["output"]["bodies"]
    time = np.asarray(bodies[0]["time"], dtype=float)
    theirs = bodies[0]["position"][:, 2] - bodies[1]["position"][:, 2]
    names = [body["name"] for body in tables_of(case)["body"]]
    ours = heave_of(results, names[0]) - heave_of(results, names[1])
    wave = tables_of(case)["wave"][0]
    if wave["type"] == "regular":
        omega = 2.0 * math.pi / wave["period"]
        name = "amplitude of the relative heave, m"
        values = amplitude(time_of(results), ours, omega), amplitude(time, theirs, omega)
    else:
        name = "standard deviation of the relative heave (other phases of the sea), m"
        half, mine = time >= 0.5 * time[-1], time_of(results) >= 0.5 * time[-1]
        values = float(np.std(ours[mine])), float(np.std(theirs[half]))
    return Figure(name, *values, f"stored, {file.name}")


def drift(results: Results, case: Path, file: Path) -> Figure:
    """Mean drift in surge at the end of the run, and that of WAMIT over a control surface.

    F = rho g T a^2, T interpolated between the periods of the numeric file.
    """
    tables, database = tables_of(case), database_of(case)
    wave, body = tables["wave"][0], tables["body"][0]["name"]
    rows = np.loadtxt(file, skiprows=1)
    surge = rows[(rows[:, 3] == 1) & (rows[:, 0] > 0.0)]
    order = np.argsort(-surge[:, 0])
    omega = 2.0 * math.pi / surge[order, 0]
    value = np.interp(2.0 * math.pi / wave["period"], omega, surge[order, 6])
    theirs = database.rho * database.gravity * value * (wave["height"] / 2.0) ** 2
    ours = float(results[f"forces/second_order/{body}/force"][-1, 0])
    return Figure("mean drift in surge, N", ours, float(theirs), "WAMIT, sphere.7")


def heave(results: Results, case: Path) -> Figure:
    """Amplitude of the first body in a regular wave, and that of linear theory.

    (-w2 (M + A) + i w (B + D) + C + K) X = F a for the heave of all bodies that move, from the
    tables of the database at the frequency of the wave: an own solution, without the kernel.
    """
    tables = tables_of(case)
    wave = tables["wave"][0]
    if wave["type"] != "regular":
        raise NoFigure("no regular wave")
    names, response, _ = _linear(tables, database_of(case))
    omega = 2.0 * math.pi / wave["period"]
    ours = amplitude(time_of(results), heave_of(results, names[0]), omega)
    exact = float(abs(response[0]))
    return Figure(f"heave amplitude of {names[0]}, m", ours, exact, "linear theory")


def mass_of(body: dict[str, Any], database: hydrodae.hdb.HydroDatabase) -> float:
    """Mass [kg], by the displaced volume of the database where it is that of equilibrium."""
    if body["mass"] != "equilibrium":
        return float(body["mass"])
    statics = database.bodies[body["hydro"]].hydrostatics
    assert statics is not None
    return database.rho * statics.displaced_volume


def _linear(
    tables: dict[str, Any], database: hydrodae.hdb.HydroDatabase
) -> tuple[list[str], np.ndarray, float]:
    """Bodies that heave, their complex amplitudes [m], and the mean absorbed power [W]."""
    wave = tables["wave"][0]
    omega = 2.0 * math.pi / wave["period"]
    names = [b["name"] for b in tables["body"] if b.get("motion") != "fixed" and "hydro" in b]
    added, damping, force = heave_tables(database, names, omega)
    mass = np.diag([mass_of(b, database) for b in tables["body"] if b["name"] in names])
    water = [waterplane_of(database, n) for n in names]
    stiffness = np.diag(np.array(water) * database.rho * database.gravity)
    joints = {joint["name"]: joint for joint in tables.get("joint", [])}
    absorbing = np.zeros_like(damping)
    for item in tables.get("force", []):
        if item["type"] not in ("pto_linear", "pto_general") or item.get("exponent", 1) != 1:
            raise NoFigure(f"linear theory of {item['type']} is not written here")
        ends = joints[item["joint"]]
        across = np.array([float(n == ends["body_b"]) - float(n == ends["body_a"]) for n in names])
        absorbing = absorbing + item.get("damping", 0.0) * np.outer(across, across)
        stiffness = stiffness + item.get("stiffness", 0.0) * np.outer(across, across)
    matrix = -(omega**2) * (mass + added) + 1j * omega * (damping + absorbing) + stiffness
    response = np.linalg.solve(matrix, force * 0.5 * wave["height"])
    taken = 0.5 * omega**2 * float(np.real(response.conj() @ absorbing @ response))
    return names, response, taken


def control(results: Results, case: Path) -> Figure:
    """Mean absorbed power of a linear controller over five periods, and that of linear theory."""
    tables = tables_of(case)
    omega = 2.0 * math.pi / tables["wave"][0]["period"]
    time = time_of(results)
    last = time >= time[-1] - 10.0 * math.pi / omega
    channels = [name for name in results if name.endswith("/power_absorbed")]
    if not channels:
        raise NoFigure("no take-off in the case")
    t = 2.0 * omega * time[last]  # a power swings at twice the frequency, by far more than its mean
    base = np.column_stack([np.ones_like(t), np.cos(t), np.sin(t)])
    power = sum(np.asarray(results[name])[last] for name in channels)
    ours = float(np.linalg.lstsq(base, power, rcond=None)[0][0])
    exact = _linear(tables, database_of(case))[2]
    return Figure("mean absorbed power of five periods, W", ours, exact, "linear theory")


def conditions(results: Results, case: Path) -> Figure:
    """Mean powers of all conditions of the study beside the case, added; linear theory of each."""
    file = case.with_name("conditions.toml")
    if not file.is_file():
        raise NoFigure("no conditions were written")
    study = tomllib.loads(file.read_text(encoding="utf-8"))["list"]
    table = hydrodae.sweep(file, case.with_name("conditions.nc"), jobs=1)
    if (table["status"] != "completed").any():
        raise NoFigure("a condition does not run to its end")
    count = len(next(iter(study.values())))
    given = hydrodae.Case.read(case)
    ours, exact = float(table["mean_power_absorbed"].sum()), 0.0
    for number in range(count):
        point = given.with_values({key: values[number] for key, values in study.items()})
        exact += _linear(dict(case_tables(point)), database_of(case))[2]
    return Figure(f"sum of the mean powers of {count} conditions, W", ours, exact, "linear theory")


def reactive(results: Results, case: Path) -> Figure:
    """Damping of the optimum of a reactive controller: that of the waves at their frequency.

    From the imported database, not from the run.
    """
    tables, database = tables_of(case), database_of(case)
    omega = 2.0 * math.pi / tables["wave"][0]["period"]
    name = next(b["name"] for b in tables["body"] if b.get("motion") != "fixed")
    _, damping, _ = heave_tables(database, [name], omega)
    return Figure(
        "optimal gain by the imported database, N s/m",
        float(damping[0, 0]),
        49181.0,
        "its input file",
    )


def decay(results: Results, case: Path) -> Figure:
    """First period of a heave decay, and the damped natural period of the tables.

    The tables are taken at that one frequency: an approximation, since the memory of the waves
    also bends the first cycle.
    """
    tables, database = tables_of(case), database_of(case)
    body = next(b for b in tables["body"] if b.get("motion") != "fixed")
    water = waterplane_of(database, body["name"])
    stiffness = water * database.rho * database.gravity
    omega = 1.0
    for _ in range(60):
        added, damping, _ = heave_tables(database, [body["name"]], omega)
        total = mass_of(body, database) + added[0, 0]
        omega = math.sqrt(stiffness / total - (0.5 * damping[0, 0] / total) ** 2)
    time, z = time_of(results), heave_of(results, body["name"])
    z = z - z[-1] if tables.get("morison") else z - body["center_of_gravity"][2]
    down = np.flatnonzero((z[:-1] > 0.0) & (z[1:] <= 0.0))
    if down.size < 2:
        return Figure("largest heave, m", float(np.max(np.abs(z))))
    crossing = time[down] + (time[down + 1] - time[down]) * z[down] / (z[down] - z[down + 1])
    ours = float(crossing[1] - crossing[0])
    return Figure("first period, s", ours, 2.0 * math.pi / omega, "tables at one frequency")


def morison(results: Results, case: Path) -> Figure:
    """Force on a monopile of 10 m in 30 m of water in a regular wave of 2 m and 5 s.

    F = 2 rho g pi D2/4 H/2 tanh(k h): the integral of the inertia force over the depth. The case is
    written here with the sizes of the example, which has an irregular sea.
    """
    rho, gravity, depth, diameter, height, omega = 1025.0, 9.81, 30.0, 10.0, 2.0, 2 * math.pi / 5
    text = f"""
[environment]
gravity = {gravity}
water_density = {rho}
water_depth = {depth}
[[wave]]
name = "wave"
type = "regular"
height = {height}
period = 5.0
[[body]]
name = "pile"
motion = "fixed"
mass = 1.0
center_of_gravity = [0.0, 0.0, -15.0]
[[morison]]
name = "pile"
body = "pile"
point_a = [0.0, 0.0, {-depth}]
point_b = [0.0, 0.0, 0.0]
diameter = {diameter}
added_mass_coefficient = 1.0
segments = 300
[solver]
end_time = 50.0
[output]
step = 0.05
"""
    file = case.with_name("monopile.toml")
    file.write_text(text, encoding="utf-8")
    run = hydrodae.run(file)
    force = np.asarray(run["forces/pile/pile/force"])[:, 0]
    k = omega**2 / gravity
    for _ in range(50):
        k = omega**2 / (gravity * math.tanh(k * depth))
    exact = 0.5 * math.pi * rho * gravity * diameter**2 * 0.5 * height * math.tanh(k * depth)
    ours = amplitude(time_of(run), force, omega)
    return Figure(
        "force on its pile in a wave of 2 m, 5 s (own case), N", ours, exact, "closed form"
    )


def power(results: Results, case: Path) -> Figure:
    """Mean absorbed power of all take-offs after half of the time."""
    channels = [name for name in results if name.endswith("/power_absorbed")]
    if not channels:
        raise NoFigure("no take-off in the case")
    if not tables_of(case).get("wave"):
        raise NoFigure("still water")
    time = time_of(results)
    last = time >= 0.5 * time[-1]
    total = sum(float(np.mean(np.asarray(results[name])[last])) for name in channels)
    return Figure("mean absorbed power after half of the time, W", total)


def stages(results: Results, case: Path, folder: Path, stage: str) -> Figure:
    """Mean power of a stage after the ramp, and that of the equations of PTO-Sim."""
    file = case.with_name("powers.toml")
    if not file.is_file():
        raise NoFigure("no powers were written")
    name = f"power_{stage}"
    wanted = tomllib.loads(file.read_text(encoding="utf-8"))["result"][name]
    ours = measure(results, (make_measure(file, name, wanted),))[name][0]
    chain = ptosim.chain_of(folder)
    source = "PTO-Sim's equations at this motion"
    if chain.kind == "simpleDDPTO":
        exact, source = _direct_drive(chain, case), "linear theory"
    else:
        law = ptosim.hydraulic if chain.kind == "hydraulicCyl" else ptosim.linear_generator
        exact = law(chain, results, "pto1")
    return Figure(f"mean {stage} power after the ramp, W", ours, exact[stage], source)


def _direct_drive(chain: Any, case: Path) -> dict[str, float]:
    tables, database = tables_of(case), database_of(case)
    wave = tables["wave"][0]
    omega = 2.0 * math.pi / wave["period"]
    body = next(b for b in tables["body"] if "hydro" in b)
    added, damping, force = heave_tables(database, [body["name"]], omega)
    stiffness = waterplane_of(database, body["name"]) * database.rho * database.gravity
    mass = mass_of(body, database) + added[0, 0]
    rest = 1j * omega * mass + damping[0, 0] + stiffness / (1j * omega)
    return dict(ptosim.direct_drive(chain, omega, rest, force[0] * 0.5 * wave["height"]))


def gauges(results: Results, case: Path) -> Figure:
    """Elevation at the last gauge over the last ten periods, and that of the Airy wave there."""
    tables = tables_of(case)
    wave, gauge = tables["wave"][0], tables["gauge"][-1]
    if wave["type"] != "regular" or len(tables["wave"]) > 1:
        raise NoFigure("no regular wave alone")
    omega = 2.0 * math.pi / wave["period"]
    depth = database_of(case).water_depth
    gravity = database_of(case).gravity
    k = omega**2 / gravity
    for _ in range(200 if math.isfinite(depth) else 0):
        k = 0.5 * (k + omega**2 / (gravity * math.tanh(k * depth)))
    heading = math.radians(wave.get("heading_deg", 0.0))
    x, y = gauge["point"]
    time = time_of(results)
    last = time >= time[-1] - 20.0 * math.pi / omega
    phase = omega * time[last] - k * (x * math.cos(heading) + y * math.sin(heading))
    airy = 0.5 * wave["height"] * np.cos(phase)
    ours = np.asarray(results[f"gauges/{gauge['name']}/elevation"])[last]
    return Figure(
        f"elevation at {gauge['name']}, square mean against the Airy wave there, m2",
        float(np.mean(ours * airy)),
        float(np.mean(airy**2)),
        "closed form",
    )


def orifice(results: Results, case: Path) -> Figure:
    """Mean power of an orifice after half of the time, and C A sqrt(2/rho) |p|^1.5 at its pressure.

    The reference is of air that keeps its density, as WEC-Sim has it.
    """
    tables = tables_of(case)
    hole, rho = tables["outlet"][0], tables["environment"]["air_density"]
    size = hole["coefficient"] * hole["area"] * math.sqrt(2.0 / rho)
    return _air(results, hole["name"], lambda p: size * np.abs(p) ** 1.5, "its formula at this p")


def turbine(results: Results, case: Path) -> Figure:
    """Mean pneumatic power of a Wells turbine after half of the time, and K D p^2/(rho W).

    W is the speed of the rotor in the run.
    """
    tables = tables_of(case)
    wells, rho = tables["outlet"][0], tables["environment"]["air_density"]
    speed = np.asarray(results[f"outlets/{wells['name']}/rotor_speed"]).ravel()
    factor = wells["flow_slope"] * wells["diameter"] / rho / speed
    return _air(results, wells["name"], lambda p: factor * p**2, "its formula at this p")


def _air(results: Results, name: str, law: Callable[[np.ndarray], np.ndarray], how: str) -> Figure:
    time = time_of(results)
    last = time >= 0.5 * time[-1]
    power = np.asarray(results[f"outlets/{name}/power"]).ravel()
    exact = law(np.asarray(results[f"outlets/{name}/pressure_drop"]).ravel())
    values = (float(np.mean(x[last])) for x in (power, exact))
    return Figure(f"mean pneumatic power of {name} after half of the time, W", *values, how)


def yaw(results: Results, case: Path) -> Figure:
    """Largest turn about z of the bodies."""
    return _turn(results, 2, "largest yaw, deg")


def faced(results: Results, case: Path) -> Figure:
    """Mean yaw of the last two periods, and that of the equation of motion."""
    exact = passive_yaw.mean_yaw(case, 2)
    time, period = time_of(results), tables_of(case)["wave"][0]["period"]
    turns = [np.asarray(results[n])[:, 2] for n in results if n.endswith("/rotation")]
    last = np.interp(time[-1] - period * np.arange(200, 0, -1) / 100.0, time, turns[-1])
    ours = float(np.rad2deg(np.mean(last)))
    return Figure("mean yaw of the last two periods, deg", ours, exact, "own integration")


def pitch(results: Results, case: Path) -> Figure:
    """Largest turn about y of the bodies."""
    return _turn(results, 1, "largest pitch, deg")


def _turn(results: Results, axis: int, name: str) -> Figure:
    turns = [np.asarray(results[n])[:, axis] for n in results if n.endswith("/rotation")]
    if not turns:
        raise NoFigure("no body moves")
    return Figure(name, float(np.rad2deg(max(np.max(np.abs(turn)) for turn in turns))))
