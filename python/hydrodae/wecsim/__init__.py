"""Runs of WEC-Sim as cases: the input file, the Simulink model and the database."""

from hydrodae.wecsim.case import Converted, convert

__all__ = ["Converted", "convert"]
