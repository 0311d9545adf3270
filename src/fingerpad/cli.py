"""The command `fingerpad`: one subcommand for each thing that can be done with a scene outside the workflow."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Mapping, Sequence
from importlib import import_module
from importlib.metadata import PackageNotFoundError, version
from io import StringIO, TextIOWrapper
from pathlib import Path

from .commands.blanks import hint_of_blanks
from .errors import FingerpadError, UnsolvedError, UsageError

FAILED = 2  # exit code [1] of anything that a user can mend; argparse has the same
INTERRUPTED = 130  # exit code [1] after Ctrl-C, as shells have it
UNSOLVED = 3  # exit code [1] where a valid scene has no certified solution

COMMANDS: Mapping[str, str] = {  # each a module in `commands`, which is loaded if it is the one that is asked for
    "new": "begin a device file of your own",
    "check": "check a device file and draw the device",
    "predict": "predict the roughness scores of devices",
    "robustness": "report which assumptions the orders of a device's scores depend on",
    "forces": "print the forces that actuators have to bear",
    "vibrate": "score a device's conditions as vibrations",
    "fields": "write the fields of a condition for ParaView",
    "export": "write a condition as an input deck in Abaqus keywords (run in CalculiX, not yet in Abaqus)",
}
DESCRIPTION = """\
Ranks the stimuli of a distributed haptic device by predicted roughness. `fingerpad COMMAND --help` has examples.

exit codes: 0 done; 1 unexpected, with a traceback; 2 what you can mend, as wrong input or a full disk; 3 the scene is
valid, but could not be solved to a certified solution; 130 interrupted.
"""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command; its exit code. A FingerpadError is printed without a traceback."""
    given = list(sys.argv[1:] if arguments is None else arguments)
    os.environ.pop("MPLBACKEND", None)  # no window is shown, and matplotlib ends at a name that it does not know
    if sys.stdout is None:  # closed, as `>&-` does: nobody reads what is printed
        sys.stdout = StringIO()
    if isinstance(sys.stdout, TextIOWrapper):
        sys.stdout.reconfigure(errors="backslashreplace")  # titles have any letters, terminals not; as stderr has it
    try:
        options, left = _parser(given[:1]).parse_known_args(given)
        if left:
            options.parser.error(f"unrecognized arguments: {' '.join(left)}{hint_of_blanks(left)}")
        _require_working_folder()
        options.run(options)
        sys.stdout.flush()
    except BrokenPipeError:  # whoever reads what is printed has read enough, as `head` has
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # nothing is left to flush at exit
    except KeyboardInterrupt:
        print("fingerpad: interrupted", file=sys.stderr)
        return INTERRUPTED
    except FingerpadError as error:
        print(f"fingerpad: {error}", file=sys.stderr)
        return UNSOLVED if isinstance(error, UnsolvedError) else FAILED
    except OSError as error:
        where = f"{error.filename}: " if error.filename else ""
        print(f"fingerpad: {where}{error.strerror or error}", file=sys.stderr)
        return FAILED
    return 0


def _parser(first: Sequence[str]) -> argparse.ArgumentParser:
    """The parser for a call that begins with that argument."""
    parser = argparse.ArgumentParser(
        prog="fingerpad", description=DESCRIPTION, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--version", action="version", version=f"%(prog)s {_version()}")
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    for name, summary in COMMANDS.items():
        command = commands.add_parser(name, help=summary, formatter_class=argparse.RawDescriptionHelpFormatter)
        if name in first:
            module = import_module(f".commands.{name}", __package__)
            command.description = module.DESCRIPTION
            command.set_defaults(run=module.run, parser=command)
            module.add(command)
    return parser


def _require_working_folder() -> None:
    """Raise UsageError if the folder in which the command is called has been removed."""
    try:
        Path.cwd()
    except FileNotFoundError as error:
        raise UsageError("the working folder is gone; go to one that is there") from error


def _version() -> str:
    """The package's version, if it is installed and not just on the path."""
    try:
        return version("fingerpad")
    except PackageNotFoundError:
        return "(not installed)"


if __name__ == "__main__":
    sys.exit(main())
