"""``python -m hydrodae``: the command line."""

import sys

from hydrodae.cli import main

sys.exit(main())
