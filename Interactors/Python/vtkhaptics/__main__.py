"""``python3 -m vtkhaptics``: the viewer."""

import sys

from .interrupt import held_back

with held_back():
    from .viewer import main

if __name__ == "__main__":
    sys.exit(main())
