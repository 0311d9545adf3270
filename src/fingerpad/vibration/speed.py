"""How fast a device vibrates, in words."""

from __future__ import annotations

SLOWLY = 0.0  # Hz: so slowly that tissue is always relaxed


def frequency_name(frequency: float) -> str:
    """What a frequency [Hz] is called in tables.

    >>> frequency_name(20.0), frequency_name(SLOWLY)
    ('20 Hz', 'slow')
    """
    return f"{frequency:g} Hz" if frequency > SLOWLY else "slow"
