"""Boundary-element runs with Capytaine: panels of shapes and meshes, lids, solution."""
