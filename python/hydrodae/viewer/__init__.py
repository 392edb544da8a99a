"""Results, or a case, in three dimensions: page, picture, video, files for ParaView."""

from __future__ import annotations

from hydrodae.viewer.browser import ViewError
from hydrodae.viewer.viewing import View, view

__all__ = ["View", "ViewError", "view"]
