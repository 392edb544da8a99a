"""What the search of the site weighs: words of other codes, and pages that come last.

`docs/site.py` writes both into the front matter of the pages, where Material for MkDocs reads them.
"""

from __future__ import annotations

import json
from fnmatch import fnmatch

#: Factors of the scores of pages; a word in a title counts 1000 times that of a text.
BOOST = {"docs/api/cpp*.md": 1e-12, "docs/api/python.md": 1e-6, "CHANGELOG.md": 1e-4}

#: Words of users of WEC-Sim, OrcaFlex and Capytaine, by the page that answers them. A word that
#: names its page finds it before all others.
WORDS = {
    "docs/cases.md": ("irregular", "nonlinear hydro", "variable hydro", "passive yaw", "morison"),
    "docs/coming_from.md": ("simulink", "wecSimInputFile", "BEMIO"),
    "docs/databases.md": ("ssCalc", "state space", "radiation IRF", "added mass"),
    "docs/extremes.md": ("extreme", "return period"),
    "docs/faq.md": ("FAQ",),
    "docs/forces.md": ("mooring matrix", "end stop", "hard stop", "drag", "MoorDyn", "catenary"),
    "docs/install.md": ("install",),
    "docs/limits.md": ("limits", "limitations"),
    "docs/pto.md": ("PTO damping", "PTO-Sim", "hydraulic"),
    "docs/reference/gauge.md": ("wave gauge", "wave marker"),
    "docs/second_order.md": ("QTF", "Newman"),
    "docs/sweeps.md": ("MCR", "power matrix", "batch"),
    "docs/view.md": ("paraview", "animation"),
}


def front_matter(page: str) -> str:
    """Front matter of a page of the site by its path in the repository; "" for most."""
    boost = next((factor for pattern, factor in BOOST.items() if fnmatch(page, pattern)), None)
    lines = [] if boost is None else [f"search: {{ boost: {boost:.15f} }}"]
    lines += [f"tags: {json.dumps(WORDS[page])}"] if page in WORDS else []
    return "".join(f"{line}\n" for line in ["---", *lines, "---"]) if lines else ""
