"""``python -m actuator_select``."""

import sys

from actuator_select.cli import main

sys.exit(main())
