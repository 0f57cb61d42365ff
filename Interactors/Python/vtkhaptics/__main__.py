"""``python3 -m vtkhaptics``: the viewer."""

import sys

from .viewer import main

sys.exit(main())
