"""Jobs of the workflow: what a script is given, and how a job ends where something goes wrong."""

from __future__ import annotations

import sys
import traceback
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from enum import Enum
from inspect import signature
from pathlib import Path
from types import UnionType
from typing import Any, Protocol, get_args, get_origin

from threadpoolctl import threadpool_limits

from .errors import FingerpadError
from .unchanged import require_unchanged


class Job(Protocol):
    """What a rule names for its script, by kind."""

    input: Mapping[str, Any]
    output: Mapping[str, Any]
    wildcards: Mapping[str, Any]
    params: Mapping[str, Any]
    threads: int
    log: Sequence[str]


def run(main: Callable[..., None], job: Job) -> None:
    """Call a script's main function with what its job has under the names of the parameters, and say in the job's logs
    why it fails. Matrix libraries take one thread, whatever the job has: two threads take longer (decision 14), and
    results depend on their number.

    Ends with status 1: at a FingerpadError with its message alone, there and on standard error; at any other error with
    the traceback. So it ends where scene files have other values than when the run began.
    """
    read = [str(each) for _, files in job.input.items() for each in ([files] if isinstance(files, str) else files)]
    with _logged(job.log), threadpool_limits(1):
        require_unchanged(read)
        main(**_given(main, job))
        require_unchanged(read)


def _given(main: Callable[..., None], job: Job) -> dict[str, Any]:
    """Arguments of the function by name, as its annotations say: inputs, outputs and parameters of the job, or where
    none has that name a wildcard, or its threads. Raises TypeError if the job has none, or several.
    """
    named = [*job.input.items(), *job.output.items(), *job.params.items()]
    implied = [*job.wildcards.items(), ("threads", job.threads)]
    given = {}
    for name, parameter in signature(main, eval_str=True).parameters.items():
        found = [value for own, value in named if own == name] or [value for own, value in implied if own == name]
        if len(found) != 1:
            raise TypeError(f"the script asks for {name}; its rule has {len(found)} of these")
        given[name] = _as(parameter.annotation, found[0])
    return given


def _as(annotation: Any, value: Any) -> Any:
    """A path, a member of an enumeration, a list or a tuple of these, or None where there is no path; anything else, as
    a tuple of any length, as it is.
    """
    if get_origin(annotation) is list:
        [member] = get_args(annotation)
        return [_as(member, each) for each in value]
    if get_origin(annotation) is tuple and Ellipsis not in get_args(annotation):
        return tuple(_as(member, each) for member, each in zip(get_args(annotation), value, strict=True))
    if get_origin(annotation) is UnionType:
        [file, _] = get_args(annotation)
        return _as(file, value) if value else None
    if isinstance(annotation, type) and issubclass(annotation, (Path, Enum)):
        return annotation(value)
    return value


@contextmanager
def _logged(logs: Sequence[str]) -> Iterator[None]:
    """Write to the logs what ends a job."""
    try:
        yield
    except FingerpadError as error:
        _append(logs, f"{error}\n")
        sys.exit(f"fingerpad: {error}")
    except Exception:
        _append(logs, traceback.format_exc())
        raise


def _append(logs: Sequence[str], text: str) -> None:
    for log in logs:
        with Path(log).open("a", encoding="utf-8") as file:
            file.write(text)
