"""What sources hold twice, by halves, or under another's label."""

from __future__ import annotations

import dataclasses
import re
import shutil

import numpy as np
import pytest
import xarray as xr
from tests.errors import refused

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database.summary import fit_summary
from hydrodae.hdb.memory import fit_memory
from hydrodae.hdb.memory.modes import Searches
from hydrodae.hdb.memory.reach import reach
from hydrodae.hdb.preparation import fitting as prepare
from hydrodae.hdb.preparation.importing import import_database
from hydrodae.hdb.readers.reading import read, read_source


@pytest.fixture
def sphere(sphere_file, tmp_path):
    """Writes a changed copy of Capytaine's sphere."""

    def written(change):
        with xr.open_dataset(sphere_file) as source:
            data = change(source.isel(omega=slice(None, None, 6)).load())
        path = tmp_path / "sphere.nc"
        data.to_netcdf(path, engine="netcdf4", format="NETCDF4")
        return path

    return written


def twice(data, second, factor=1.0):
    """The first heading again, as another, its forces times a factor."""
    data = data.isel(wave_direction=[0, 0])
    data = data.assign_coords(wave_direction=[0.0, second]).copy(deep=True)
    for name in ("diffraction_force", "Froude_Krylov_force"):
        values = data[name].transpose("wave_direction", ...).values.copy()
        values[1] *= factor
        data[name] = (data[name].transpose("wave_direction", ...).dims, values)
    return data.drop_vars("excitation_force", errors="ignore")


def test_a_heading_that_stands_there_twice(sphere):
    once = read_source(sphere(lambda d: twice(d, 0.0)))
    assert once.heading.tolist() == [0.0]
    assert any("0 deg stand there twice" in f.message for f in once.findings)
    # runs look up headings between the first and the last: a full turn stays
    turn = read_source(sphere(lambda d: twice(d, 2.0 * np.pi).isel(wave_direction=[1, 0])))
    assert np.degrees(turn.heading) == pytest.approx([0.0, 360.0])
    for second in (0.0, 2.0 * np.pi):
        path = sphere(lambda d, second=second: twice(d, second, 1.5))
        with refused("headings"):
            read_source(path)


def test_forward_speed_is_refused(sphere):
    path = sphere(lambda d: d.assign_coords(forward_speed=2.0))
    with refused("unsupported", "forward_speed"):
        read_source(path)


def test_labels_that_are_exchanged_are_an_error(sphere):
    other = {"Heave": "Pitch", "Pitch": "Heave"}

    def exchanged(data):
        labels = [
            re.sub("Heave|Pitch", lambda m: other[m[0]], str(v)) for v in data.radiating_dof.values
        ]
        return data.assign_coords(radiating_dof=labels)

    path = sphere(exchanged)
    _, report = import_database(path)
    assert report.find("coupling of added_mass")[0].severity == "error"


def test_one_half_of_a_table_of_wamit_gives_the_other(reference, tmp_path):
    folder = tmp_path / "half"
    shutil.copytree(reference / "hdb" / "cylinder_hams", folder)
    whole = read(folder)
    path = next(folder.rglob("*.1"))
    rows = [line for line in path.read_text().splitlines() if line.strip()]
    upper = [row for row in rows if int(row.split()[1]) <= int(row.split()[2])]
    assert len(upper) < len(rows)
    path.write_text("\n".join(upper))
    data = read_source(folder)
    assert any("the other is taken from it, by reciprocity" in f.message for f in data.findings)
    size = np.abs(whole.added_mass).max()
    np.testing.assert_allclose(read(folder).added_mass, whole.added_mass, atol=2e-3 * size)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (r"\n(\d+)\t([\d.]+\t[\d.]+\s*!)", r"\n-\1\t\2", "the number of frequencies, got -"),
        (r"\n1(\t0\.\t0\.\s*!)", r"\n1000000000000\1", "the number of headings, got 1e"),
        (r"-2\.000000", "-2,000000", r"'-2,000000': write -2\.000000 or '-2 000000'"),
        (r"\n50\. ", "\n50,5 ", r"Nemoh\.cal:4: the water depth: '50,5': write 50\.5"),
    ],
)
def test_numbers_of_nemoh_cal_that_are_none(reference, tmp_path, old, new, message):
    folder = tmp_path / "run"
    shutil.copytree(reference / "hdb" / "sphere_nemoh_v2.3", folder)
    path = folder / "Nemoh.cal"
    path.chmod(0o644)
    text = re.sub(old, new, path.read_text(), count=1)
    assert text != path.read_text()
    path.write_text(text)
    with pytest.raises(DatabaseError, match=message):
        read_source(folder)


def test_a_fit_does_not_follow_what_breaks_energy_outside_the_band(sphere_tables):
    whole = sphere_tables.select(["sphere.heave"])
    b = whole.radiation_damping.copy()
    b[(whole.omega > 4.9) & (whole.omega < 5.4)] -= 0.4 * b.max()  # as an irregular frequency
    noisy = dataclasses.replace(whole, radiation_damping=b)
    made = prepare.fit(noisy, "sphere.heave", band=(0.3, 2.5), target=1e-3)
    fit = made.memory["default"]
    assert "outside the band, break causality or energy: left out" in fit_summary(fit)
    assert fit.report["passive"]
    assert fit.report["h_error_band"] < 2e-4
    with pytest.raises(DatabaseError, match="misses its target") as refused:
        prepare.fit(noisy, "sphere.heave", band=(0.3, 7.0), target=1e-3)
    assert "rad/s, in the band, and what gives energy" in str(refused.value)
    assert "break causality or energy: " in str(refused.value)
    assert "compute again with a lid (finer" in str(refused.value)


def test_a_fit_takes_the_poles_of_the_look_before_it(repository) -> None:
    database = read(repository / "cases" / "sphere" / "hydro.h5")
    looked: Searches = {}
    reach(database, ["sphere.heave"], searches=looked)
    alone: Searches = {}
    expected = fit_memory(database, ["sphere.heave"], searches=alone)
    taken = looked.copy()
    made = fit_memory(database, ["sphere.heave"], searches=taken)
    assert np.array_equal(made.poles, expected.poles)
    assert looked
    assert looked.keys() <= alone.keys()
    assert taken.keys() == alone.keys()
