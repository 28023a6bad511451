"""`python -m singsym` is the command `singsym`."""

import sys

from singsym.cli import main

if __name__ == "__main__":
    sys.exit(main())
