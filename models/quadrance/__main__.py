"""`python -m quadrance`: the same as the command `quadrance`."""

import sys

from quadrance.cli import main

sys.exit(main())
