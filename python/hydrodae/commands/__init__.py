"""The commands of `hydrodae`: they read arguments, call the package and print."""

import os

# Matrices of a device are small: threads of BLAS wait for each other longer than they compute, 20
# times as long on a busy machine. A value from outside holds.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
