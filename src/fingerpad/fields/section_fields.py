"""Full displacement and strain fields of the section, for the figures that draw them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray


@dataclass(frozen=True)
class Fields:
    """Fields of several loadings, on triangles of their own (strain jumps between elements).

    corner: (2, 3 n_elements) undeformed corners [mm], three an element. interface, receptors, boundary: (k, 2) corners
    at the ends of the facets between layers, but for those of the receptor line, of that line, and on the outside.
    displacement: (n_loadings, 2, 3 n_elements) [mm]. strain:
    (n_loadings, 3 n_elements) maximum principal strain [1]. change: (n_loadings, 3 n_elements) of it since the
    pre-indented state [1].
    """

    corner: FloatArray
    interface: np.ndarray
    receptors: np.ndarray
    boundary: np.ndarray
    displacement: FloatArray
    strain: FloatArray
    change: FloatArray
