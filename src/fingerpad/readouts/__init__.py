"""From strain at the receptors to a score and its error: read-outs, resampling, Gabor filter, area."""
