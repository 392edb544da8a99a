"""One case: its file, its tables and their schema, scenes built in Python, what a caller gives."""

from hydrodae.case.case import Case

__all__ = ["Case"]
