"""What the commands of the program start: `python3 __main__.py COMMAND OPTIONS FOLDER...`, the options as JSON."""

import importlib
import json
import os
import signal
import sys
import warnings

PACKAGES = ("gsd", "h5py", "jinja2", "matplotlib", "numpy", "scipy", "sklearn", "yaml")  # python3-NAME of Debian
PIP = {"sklearn": "scikit-learn", "yaml": "PyYAML"}  # where it has another name


def report_failure(code: int, line: str) -> int:
    print(f"clca: error: {line}", file=sys.stderr)
    return code


def report_missing_module(error: ImportError) -> int:
    name = error.name or ""
    more = f"no Python module {name}; install python3-{name} (Debian) or {PIP.get(name, name)} (pip)"
    return report_failure(1, more if name in PACKAGES else str(error))


def main() -> int:
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)
    os.environ.setdefault("MPLBACKEND", "agg")
    sys.path[0] = os.path.dirname(sys.path[0])  # the folder of the package, not of its modules
    try:
        from clca._error import Error, WriteError, printable
    except ImportError as error:
        return report_missing_module(error)
    warnings.showwarning = lambda text, *_: print(f"clca: warning: {printable(str(text))}", file=sys.stderr, flush=True)
    try:
        importlib.import_module(f"clca._{sys.argv[1]}").command(json.loads(sys.argv[2]), *sys.argv[3:])
    except Error as error:
        line = str(error)
        if error.line is None:
            return report_failure(1 if isinstance(error, WriteError) else 2, line)
        print(line, file=sys.stderr)  # as of a scene
        return 2
    except ImportError as error:
        return report_missing_module(error)
    except Exception as error:  # one line, as of the program
        return report_failure(1, printable(f"{type(error).__name__}: {error}".splitlines()[0]))
    return 0


if __name__ == "__main__":
    sys.exit(main())
