"""``python -m hydrodae``: the command line."""

import sys

from hydrodae.commands.cli import main

sys.exit(main())
