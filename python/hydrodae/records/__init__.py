"""Measured records: tables of text and of MATLAB, their clocks, seas as spectra and components."""

from hydrodae.records.components import Component, read_components
from hydrodae.records.elevation import Elevation, read_elevation
from hydrodae.records.spectrum import Spectrum, read_spectrum
from hydrodae.records.table import Table, read_table

__all__ = [
    "Component",
    "Elevation",
    "Spectrum",
    "Table",
    "read_components",
    "read_elevation",
    "read_spectrum",
    "read_table",
]
