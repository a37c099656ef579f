"""What the commands of the program start: `python3 -m clca COMMAND OPTIONS`, the options as JSON."""

import json
import os
import signal
import sys

from ._error import Error


def main() -> int:
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)
    os.environ.setdefault("MPLBACKEND", "agg")
    try:
        name, options = sys.argv[1], json.loads(sys.argv[2])
        from . import _plot

        {"plot": _plot.command}[name](options, *sys.argv[3:])
    except Error as error:
        print(error, file=sys.stderr)
        return 2
    except ImportError as error:
        package = {"matplotlib": "python3-matplotlib", "h5py": "python3-h5py", "numpy": "python3-numpy"}
        more = f"; install {package[error.name]} (Debian) or {error.name} (pip)" if error.name in package else ""
        print(f"no Python module {error.name}{more}" if more else error, file=sys.stderr)
        return 1
    except Exception as error:  # one line, as of the program
        print(f"{type(error).__name__}: {error}".splitlines()[0], file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
