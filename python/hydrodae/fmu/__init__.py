"""Functional mock-up units (FMU): a case as a component for other programs.

An FMU is a zip archive of the FMI standard (fmi-standard.org): a shared library with the kernel,
the case with its database, and an XML file that lists the variables.
"""

from hydrodae.fmu.archive import export

__all__ = ["export"]
