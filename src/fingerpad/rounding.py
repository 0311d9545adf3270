"""A value and its error as text: each as far as the error tells."""

from __future__ import annotations

import math

DIGITS = 4  # significant digits of a value without an error [1]


def rounded(value: float, error: float) -> tuple[str, str]:
    """A value and its error: the error with its first digit, or two if that is a one, and whole from 10 on; the value
    as far as these reach.

    >>> rounded(0.49387, 0.01868), rounded(0.31891, 0.00057), rounded(123.4, 56.0)
    (('0.494', '0.019'), ('0.3189', '0.0006'), ('123', '56'))

    >>> rounded(-0.0004, 0.02)
    ('0.00', '0.02')

    Of an error that is not known, as not finite, that is said.

    >>> rounded(0.324622, math.nan), rounded(0.324622, math.inf), rounded(0.324622, 0.0)
    (('0.3246', '?'), ('0.3246', '?'), ('0.3246', '0'))
    """
    if not 0.0 < error < math.inf:
        return f"{value:.{DIGITS}g}", "0" if error <= 0.0 else "?"
    first = math.floor(math.log10(error))
    decimals = max(-first + (error < 2.0 * 10.0**first), 0)
    return f"{value:z.{decimals}f}", f"{error:.{decimals}f}"  # z: nothing is -0
