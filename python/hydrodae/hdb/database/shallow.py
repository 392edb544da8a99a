"""Frequencies of a run with Capytaine that needed the Green function of shallow water."""

from __future__ import annotations

import numpy as np
import xarray as xr

from hydrodae.hdb.database.findings import Finding

#: Attribute of the netCDF file: frequencies [rad/s] that were solved with FinGreen3D.
SHALLOW = "shallow_omega"


def shallow_findings(data: xr.Dataset) -> list[Finding]:
    """Report the frequencies of a netCDF file that were solved with FinGreen3D."""
    omega = np.atleast_1d(data.attrs.get(SHALLOW, []))
    if not omega.size:
        return []
    text = (
        f"{omega.size} frequencies up to {omega.max():.4g} rad/s have waves too long for "
        f"Capytaine's usual Green function of a finite depth: solved with FinGreen3D, without a "
        f"lid, to some per cent"
    )
    return [Finding("warning", "shallow water", text, omega=float(omega.max()))]
