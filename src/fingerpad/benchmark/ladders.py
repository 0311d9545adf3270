"""Names of the solvers whose run times are set against their errors, and the error at which they are compared."""

from __future__ import annotations

OWN_LADDER, FIRST_ORDER_LADDER, PLAIN_LADDER = "fingerpad", "first-order elements", "factorised anew"
CALCULIX_LADDER = "CalculiX"
COMPARED_AT = 0.01  # error of a score [1] at which run times are compared; source: twice what default meshes aim at
