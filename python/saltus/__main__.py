"""`python -m saltus`: the command `saltus`."""

import sys

from saltus.cli import main

sys.exit(main())
