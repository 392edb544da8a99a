"""One database: its tables and labels, its files, and what follows from its tables alone."""

from hydrodae.hdb.database.database import HydroDatabase

__all__ = ["HydroDatabase"]
