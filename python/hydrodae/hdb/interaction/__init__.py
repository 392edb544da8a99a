"""Databases of equal vertical cylinders by the interaction theory of Kagemoto and Yue (1986)."""
