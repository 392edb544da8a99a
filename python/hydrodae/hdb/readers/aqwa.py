"""Output of AQWA: `.AH1` (all coefficients as numbers), or the listing `.LIS`.

AQWA's forces are F cos(wt - phase): the phase is a lag, counted from the crest at the centre of
gravity. With x(t) = Re(X e^{+iwt}) and the phase zero at the origin of the world,
X = F e^{-i phase} e^{-i k x'_G}. Directions are those of travel. Moments, A, B and the stiffness
are about the centre of gravity; about that point the stiffness holds no weight term.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.readers.aqwa_common import aqwa_data
from hydrodae.hdb.readers.aqwa_listing import read_listing
from hydrodae.hdb.readers.formats import Format
from hydrodae.hdb.readers.source import SourceData
from hydrodae.hdb.readers.text import only, read_lines, row_of
from hydrodae.support.arrays import Array
from hydrodae.support.naming import names_file


def aqwa_file(path: Path) -> Path | None:
    """Return the file of AQWA that is meant by a file or folder; None without one.

    Of a folder it is the one `.AH1`, else the one `.LIS`.

    Raises
    ------
    DatabaseError
        Several files of the kind.
    """
    if path.is_file():
        return path if path.suffix.lower() in (".ah1", ".lis") else None
    for suffix in (".ah1", ".lis"):
        found = [p for p in sorted(path.iterdir()) if p.suffix.lower() == suffix]
        if found:
            return only(found)
    return None


@names_file
def read_aqwa(path: Path) -> SourceData:
    """Read an `.AH1` file, or a `.LIS` listing.

    Returns
    -------
    SourceData
        Added mass at 100 rad/s, where AQWA was asked for it, becomes `added_mass_inf`.

    Raises
    ------
    DatabaseError
        Something is missing or wrong; the message names file and line.
    """
    if path.suffix.lower() == ".lis":
        return read_listing(path)
    return _Ah1(path).data()


class _Ah1:
    """The sections of an `.AH1` file; numbers are read as one stream per section."""

    def __init__(self, path: Path) -> None:
        self.path = path
        lines = read_lines(path)
        self.sections: dict[str, tuple[int, list[float]]] = {}
        word, start, numbers = "", 0, list[float]()
        for count, line in enumerate(lines, start=1):
            if line.startswith("*") or not line.strip():
                continue
            if line[0].isalpha():
                self.sections[word] = (start, numbers)
                word, start, numbers = line.split()[0], count, []
                continue
            numbers += row_of(line.split(), count)
        self.sections[word] = (start, numbers)
        self._header()

    def _header(self) -> None:
        """Structures, headings [deg] and frequencies [rad/s]; equal for all structures."""
        values = self.sections[""][1]
        headings, grids = list[list[float]](), list[list[float]]()
        while values:
            count = [int(v) for v in values[1:3] if v == int(v) and v > 0.0]
            if len(count) != 2 or values[0] != len(grids) + 1:
                raise DatabaseError(
                    f"its head, before the first section: expected the number of a "
                    f"structure ({len(grids) + 1}), of directions and of frequencies, got "
                    f"{' '.join(f'{v:g}' for v in values[:3])}"
                ).about("format")
            nh, nw = count
            headings.append(values[3 : 3 + nh])
            grids.append(values[3 + nh : 3 + nh + nw])
            if len(grids[-1]) != nw:
                raise DatabaseError(f"its head is cut short: {nw} frequencies stated").about(
                    "cut_short"
                )
            values = values[3 + nh + nw :]
        if (
            not grids
            or any(g != grids[0] for g in grids)
            or any(h != headings[0] for h in headings)
        ):
            raise DatabaseError("structures with different frequencies or headings").about(
                "conflict"
            )
        self.count = len(grids)
        self.omega, self.heading_deg = np.array(grids[0]), np.array(headings[0])

    def block(self, word: str, counts: tuple[int, ...], width: int) -> Array:
        """Numbers of a section, (entries, width); each entry begins with its indices from 1."""
        if word not in self.sections:
            raise DatabaseError(f"no section {word}").about("missing", word)
        line, values = self.sections[word]
        entries, length = int(np.prod(counts)), len(counts) + width
        if len(values) != entries * length:
            raise DatabaseError(
                f"section {word} holds {len(values)} numbers, expected {entries * length}"
            ).about("shape", word, line=line)
        table = np.array(values).reshape(entries, length)
        indices = np.indices(counts).reshape(len(counts), -1).T + 1
        wrong = np.flatnonzero((table[:, : len(counts)] != indices).any(axis=1))
        if wrong.size:
            found, expected = (
                " ".join(f"{v:g}" for v in rows[wrong[0], : len(counts)])
                for rows in (table, indices)
            )
            raise DatabaseError(
                f"section {word}: entry {wrong[0] + 1} begins with {found}, "
                f"expected {expected}: lines are missing, twice or in another order"
            ).about("order", word, line=line)
        return table[:, len(counts) :]

    def _each_alone(self, word: str) -> bool:
        """Whether a section has entries 1 1, 2 2 ... of 36 numbers, and none of two structures."""
        values = self.sections.get(word, (0, []))[1]
        if self.count == 1 or len(values) != 38 * self.count:
            return False
        places = np.arange(1, self.count + 1)
        return np.array_equal(np.reshape(values, (-1, 38))[:, :2].T, [places, places])

    def matrices(self, word: str) -> Array:
        """A or B, (nw, 6 n, 6 n): entries i, j, frequency, 36 numbers."""
        n, nw = self.count, self.omega.size
        table = self.block(word, (n, n, nw), 36).reshape(n, n, nw, 6, 6)
        return np.asarray(table.transpose(2, 0, 3, 1, 4).reshape(nw, 6 * n, 6 * n))

    def data(self) -> SourceData:
        """Put the sections together."""
        n, nw, nh = self.count, self.omega.size, self.heading_deg.size
        depth, rho, gravity = self.block("GENERAL", (n,), 5)[0, :3]
        centers = list(self.block("COG", (n,), 3))
        force = self.block("FORCERAO", (n, nh, nw), 12).reshape(n, nh, nw, 2, 6)
        turned = force[:, :, :, 0] * np.exp(-1j * np.radians(force[:, :, :, 1]))
        a_inf = None
        alone = self._each_alone("ADDEDMASS_HF")
        if "ADDEDMASS_HF" in self.sections and not alone:
            table = self.block("ADDEDMASS_HF", (n, n), 36).reshape(n, n, 6, 6)
            a_inf = table.transpose(0, 2, 1, 3).reshape(6 * n, 6 * n)
        data = aqwa_data(
            self.path,
            self.omega,
            (self.matrices("ADDEDMASS"), self.matrices("DAMPING"), a_inf),
            self.heading_deg,
            {
                "excitation": np.asarray(
                    turned.transpose(2, 1, 0, 3).reshape(nw, nh, 6 * n), complex
                )
            },
            centers,
            (rho, gravity, depth),
        )
        if alone:
            text = "ADDEDMASS_HF holds that of each structure alone: estimated from A and B instead"
            data.findings.append(Finding("info", "added_mass_inf of the source", text))
        buoyancy = self.block("COB", (n,), 3)
        volume = self.block("DISPLACEMENT", (n,), 1)[:, 0]
        stiffness = data.setting.unit * self.block("HYDSTIFFNESS", (n,), 36).reshape(n, 6, 6)
        for i, name in enumerate(data.reference_points):
            data.add_statics(name, stiffness[i], centers[i], float(volume[i]), buoyancy[i])
        return data


FORMAT = Format(".AH1 or .LIS of AQWA", aqwa_file, read_aqwa)
