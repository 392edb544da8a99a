"""What a message about an unknown name adds: the one that was probably meant."""

from __future__ import annotations

from collections.abc import Iterable


def did_you_mean(name: object, names: Iterable[str], otherwise: str = "") -> str:
    """Return "; did you mean 'x'?" for the nearest name, `otherwise` where none is near.

    Examples
    --------
    >>> did_you_mean("heav", ["heave", "pitch"])
    "; did you mean 'heave'?"
    """
    import difflib

    near = difflib.get_close_matches(str(name), list(names), n=1)
    return f"; did you mean {near[0]!r}?" if near else otherwise
