"""Directed graphs without cycles: read from DOT, thinned to the edges that say something, and laid out in layers."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from functools import cache
from graphlib import TopologicalSorter
from itertools import pairwise
from statistics import mean

import numpy as np
from scipy.optimize import isotonic_regression

NODE = re.compile(r'^\s*(\d+)\s*\[label = "([^"\\]*)', re.MULTILINE)  # up to an escape, behind which stand wildcards
EDGE = re.compile(r"^\s*(\d+) -> (\d+)\s*$", re.MULTILINE)
SWEEPS = 40  # down and up over the layers, half of them with a new order [1]; source: places move no more

Edge = tuple[str, str]


def read_dot(text: str) -> list[Edge]:
    """Edges (from, to) by labels, sorted, of a graph in the DOT form that workflow tools print.

    >>> read_dot('digraph { \\n 0[label = "b"];\\n 1[label = "a"];\\n 1 -> 0\\n}')
    [('a', 'b')]
    """
    labels = dict(NODE.findall(text))
    return sorted({(labels[start], labels[stop]) for start, stop in EDGE.findall(text)})


def reduced(edges: Iterable[Edge]) -> list[Edge]:
    """The edges without those that another path implies (transitive reduction)."""
    after: dict[str, set[str]] = {}
    for start, stop in edges:
        after.setdefault(start, set()).add(stop)

    @cache
    def reached(node: str) -> set[str]:
        return after.get(node, set()).union(*(reached(other) for other in after.get(node, ())))

    return sorted(
        (start, stop)
        for start, stops in after.items()
        for stop in stops
        if not any(stop in reached(other) for other in stops - {stop})
    )


def levels(edges: Iterable[Edge], nodes: Iterable[str] = ()) -> dict[str, int]:
    """Level of each node: 0 if no edge ends in it, else one above the highest from which an edge comes. nodes: those
    that may be without edges. Raises CycleError (graphlib), which names them, if edges lead back to where they began.

    >>> levels([("a", "b"), ("b", "d"), ("c", "d")])
    {'a': 0, 'c': 0, 'b': 1, 'd': 2}
    """
    sorter = TopologicalSorter[str](dict.fromkeys(nodes, ()))
    for start, stop in edges:
        sorter.add(stop, start)
    sorter.prepare()
    found: dict[str, int] = {}
    level = 0
    while sorter.is_active():
        ready = sorter.get_ready()
        found |= dict.fromkeys(ready, level)
        sorter.done(*ready)
        level += 1
    return found


def layers(edges: Iterable[Edge]) -> dict[str, int]:
    """Layer of each node, 0 at the top: as low as what follows allows, so that edges are short.

    >>> layers([("a", "b"), ("b", "d"), ("c", "d")])
    {'a': 0, 'b': 1, 'c': 1, 'd': 2}
    """
    heights = levels((stop, start) for start, stop in edges)
    return {node: max(heights.values()) - heights[node] for node in sorted(heights)}


def placed(edges: Sequence[Edge]) -> tuple[dict[str, tuple[float, int]], list[list[tuple[float, int]]]]:
    """Places (x, layer) of nodes, and the polyline of each edge; neighbours in a layer are 1 apart or more.

    An edge takes a place of its own in each layer that it crosses. Layers are ordered by the mean place of neighbours
    (Sugiyama's method); each node is then put as near to that mean as its neighbours in the layer allow.
    """
    layer = layers(edges)
    chains = []
    for start, stop in edges:
        between = [f"{start} {stop} {level}" for level in range(layer[start] + 1, layer[stop])]
        layer |= {name: layer[start] + 1 + number for number, name in enumerate(between)}
        chains.append([start, *between, stop])
    rows = [sorted(name for name, level in layer.items() if level == row) for row in range(max(layer.values()) + 1)]
    links = [link for chain in chains for link in pairwise(chain)]
    near: dict[str, list[str]] = {name: [] for name in layer}
    for start, stop in links:
        near[start].append(stop)
        near[stop].append(start)
    x = {name: number - (len(row) - 1) / 2.0 for row in rows for number, name in enumerate(row)}
    for sweep in range(SWEEPS):
        for row in rows if sweep % 2 == 0 else rows[::-1]:
            wanted = {name: mean(x[other] for other in near[name]) for name in row}
            if sweep < SWEEPS // 2:
                row.sort(key=lambda name: (wanted[name], name))
            x |= _apart([(name, wanted[name]) for name in row])
    return (
        {name: (x[name], layer[name]) for name in sorted({name for edge in edges for name in edge})},
        [[(x[name], layer[name]) for name in chain] for chain in chains],
    )


def _apart(wanted: Sequence[tuple[str, float]]) -> dict[str, float]:
    """Places nearest to those wanted, in the same order and 1 apart or more (least squares: isotonic regression)."""
    steps = np.arange(len(wanted))
    places = isotonic_regression(np.array([place for _, place in wanted]) - steps).x + steps
    return {name: float(place) for (name, _), place in zip(wanted, places, strict=True)}
