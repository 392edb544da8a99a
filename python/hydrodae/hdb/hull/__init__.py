"""The hull of a body: its mesh, what floats of it, its hydrostatic stiffness."""
