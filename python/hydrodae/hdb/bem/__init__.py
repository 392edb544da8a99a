"""Boundary-element runs of one's own: panels of shapes and meshes, lids, Capytaine."""
