"""`slipwise` and `python -m slipwise`: signals are heard while the command line is still being loaded."""

import sys

from slipwise.interruption import Stopped, stoppable
from slipwise.standard_streams import open_standard_streams


def main() -> None:
    """Run the command line."""
    open_standard_streams()
    try:
        with stoppable():
            from slipwise.cli import main as command_line

            command_line()
    except Stopped as stop:
        print(stop, file=sys.stderr)
        sys.exit(stop.code)


if __name__ == "__main__":
    main()
