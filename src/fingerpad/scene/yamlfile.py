"""YAML of scene files, read strictly: a value is what is written, and a message says what is wrong in which line."""

from __future__ import annotations

import functools
import re
import unicodedata
from pathlib import Path
from typing import Any

import yaml

from ..errors import SceneError
from ..files import require_readable

MERGE, TEXT, BOOLEAN, INTEGER, FLOAT = (f"tag:yaml.org,2002:{end}" for end in ("merge", "str", "bool", "int", "float"))
# as YAML 1.2 has them; PyYAML reads YAML 1.1, in which 045 is 37, 1:30 is 90, 1e-3 a text, and a condition `off` false
PLAIN = {
    BOOLEAN: r"(true|True|TRUE|false|False|FALSE)$",
    INTEGER: r"[-+]?[0-9]+$",
    FLOAT: r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?$|[-+]?\.(inf|Inf|INF)$|\.(nan|NaN|NAN)$",
}
HALVES = re.compile("[\ud800-\udfff]")  # of letters beyond U+FFFF, which no file can hold
MOST_REPEATED = 100_000  # values [1] that aliases may repeat; source: assumption: rows of a history that are alike
ODD_BLANKS = r"[^\S \t\r\n]|[\u200b\u2060]"
TABS = "; indent with spaces"
QUOTES = "; text with a colon or a comma needs quotes"  # what is wrong most often where a flow mapping is not one
REMEMBERED = 16  # texts of files [1]; source: config, two schemas and some devices
LARGEST_FILE = 10_000_000  # bytes; source: the longest history that the schema allows takes as much


class _Loader(yaml.SafeLoader):
    """Refuses what PyYAML would take: a key twice (it takes the last), merges, tags, and aliases of aliases, which make
    lists beyond any memory from a few lines. Its numbers and truths are PLAIN.
    """

    yaml_implicit_resolvers = {  # noqa: RUF012 - PyYAML's own name, which it copies before it adds to it
        first: [each for each in known if each[0] not in PLAIN]
        for first, known in yaml.SafeLoader.yaml_implicit_resolvers.items()
    }

    def get_single_node(self) -> yaml.Node | None:
        node = super().get_single_node()
        known: dict[int, int] = {}
        if node is not None and _written_out(node, known) - len(known) > MOST_REPEATED:
            problem = f"found aliases that repeat more than {MOST_REPEATED} values, allowed: values written out"
            raise yaml.MarkedYAMLError(problem=problem)
        return node

    def compose_node(self, parent: yaml.Node | None, index: Any) -> yaml.Node | None:
        event = self.peek_event()  # type: ignore[no-untyped-call]  # so are the stubs
        if (tag := getattr(event, "tag", None)) is not None:
            tag = tag.replace("tag:yaml.org,2002:", "!!")
            raise yaml.MarkedYAMLError(problem=f"found the tag {tag}, allowed: none", problem_mark=event.start_mark)
        if half := HALVES.search(getattr(event, "value", "")):
            problem = f"found {half[0]!a}, which is half of a letter, allowed: whole letters, as they are"
            raise yaml.MarkedYAMLError(problem=problem, problem_mark=event.start_mark)
        return super().compose_node(parent, index)

    def compose_mapping_node(self, anchor: Any) -> yaml.MappingNode:
        node = super().compose_mapping_node(anchor)
        seen: dict[str, int] = {}
        for key, _ in node.value:
            if not isinstance(key, yaml.ScalarNode) or key.tag == MERGE:
                found = f"{key.id} as a key" if key.tag != MERGE else "merge key <<"
                problem = f"found a {found}, allowed: texts as keys, each with its value written out"
                raise yaml.MarkedYAMLError(problem=problem, problem_mark=key.start_mark)
            if key.value in seen:
                problem = f"found the key {key.value!r} twice (first in line {seen[key.value]}), allowed once"
                raise yaml.MarkedYAMLError(problem=problem, problem_mark=key.start_mark)
            seen[key.value] = key.start_mark.line + 1
            key.tag = TEXT  # {value: 0,025} has the key 025, which is 25 to YAML; and 90 is no place in a list
        return node

    def construct_integer(self, node: yaml.ScalarNode) -> int:
        try:
            return int(node.value)
        except ValueError as error:  # more digits than Python reads
            problem = f"found a number of {len(node.value)} digits, allowed: numbers that people write"
            raise yaml.MarkedYAMLError(problem=problem, problem_mark=node.start_mark) from error


for _tag, _pattern in PLAIN.items():
    _Loader.add_implicit_resolver(_tag, re.compile(_pattern), list("-+.0123456789tTfF"))
_Loader.add_constructor(INTEGER, _Loader.construct_integer)


def read_yaml(path: Path) -> dict[str, Any]:
    """The mapping in a YAML file.

    Raises SceneError if the file is missing, empty, too large, not YAML, or has a key twice, a tag or many aliases.
    """
    text = ""
    try:
        require_readable(path, LARGEST_FILE, "YAML", SceneError)
        text = path.read_text(encoding="utf-8")
        node = _composed(text)
        document = None if node is None else _Loader("").construct_document(node)
    except OSError as error:
        raise SceneError(f"{path}: cannot be read as a YAML file: {error.strerror}") from error
    except UnicodeDecodeError as error:
        line = 1 + error.object.count(b"\n", 0, error.start)
        found = f"found byte 0x{error.object[error.start]:02x}"
        raise SceneError(f"{path}: line {line}: must be UTF-8 text, {found}; save it as UTF-8") from error
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark
        where = f"line {mark.line + 1}, column {mark.column + 1}: " if mark else ""
        begun = error.context_mark
        context = f" ({error.context} that began in line {begun.line + 1})" if begun else ""
        hint = QUOTES if "flow mapping" in str(error.context) else TABS if r"\t" in str(error.problem) else ""
        told = f"{where}{error.problem}{context}{hint}{_odd_blank(text)}"
        raise SceneError(f"{path}: is not valid YAML: {told}") from error
    except RecursionError as error:
        raise SceneError(f"{path}: is nested too deeply; allowed: the few levels of the shipped files") from error
    except (yaml.YAMLError, ValueError) as error:
        raise SceneError(f"{path}: is not valid YAML: {' '.join(str(error).split())}") from error
    if not isinstance(document, dict):
        found = "an empty file" if document is None else f"the {type(document).__name__} {document!r:.40}"
        raise SceneError(f"{path}: must hold a mapping of keys to values, found {found}")
    return document


def _odd_blank(text: str) -> str:
    """The end of a message that names the first blank of a text that is none to YAML, as editors and web pages have."""
    if not (found := re.search(ODD_BLANKS, text)):
        return ""
    line, name = 1 + text.count("\n", 0, found.start()), unicodedata.name(found[0], ascii(found[0])).lower()
    return f"; line {line} has a {name}, which is no blank to YAML"


def read_values(text: str) -> list[Any]:
    """The values that a text lists as a scene file would, between commas; none if it is no such text.

    >>> read_values("0.3, 0.6"), read_values("[0, 1], [1, 0]"), read_values("0.3]")
    ([0.3, 0.6], [[0, 1], [1, 0]], [])
    """
    try:
        node = _composed(f"[{text}]")
        values = [] if node is None else _Loader("").construct_document(node)
    except (yaml.YAMLError, ValueError, RecursionError):
        return []
    return values if isinstance(values, list) else []


@functools.lru_cache(maxsize=REMEMBERED)  # a workflow reads each of its few files many times, and this takes longest
def _composed(text: str) -> yaml.Node | None:
    """The nodes of a YAML text."""
    return yaml.compose(text, _Loader)


def _written_out(node: yaml.Node, known: dict[int, int]) -> int:
    """Number of nodes below and with a node if aliases were written out. known: of each node, 0 while it is counted."""
    if id(node) not in known:
        known[id(node)] = 0
        pairs = node.value if isinstance(node, yaml.MappingNode) else []
        children = node.value if isinstance(node, yaml.SequenceNode) else [child for pair in pairs for child in pair]
        known[id(node)] = 1 + sum(_written_out(child, known) for child in children)
    elif known[id(node)] == 0:
        problem = "found an alias of what it is a part of, allowed: aliases of other values"
        raise yaml.MarkedYAMLError(problem=problem, problem_mark=node.start_mark)
    return known[id(node)]
