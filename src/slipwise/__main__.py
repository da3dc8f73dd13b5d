"""`slipwise` and `python -m slipwise`: signals are heard while the command line is still being loaded."""

import sys

if __name__ == "__main__" and not sys.flags.safe_path:
    # `python -m` looks for modules in the current folder first: a stranger's folder may hold a numpy.py
    del sys.path[0]

from slipwise.jobs.interruption import Stopped, stoppable  # noqa: E402
from slipwise.standard_streams import open_standard_streams  # noqa: E402


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
