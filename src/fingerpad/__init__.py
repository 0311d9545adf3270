"""fingerpad: predicts which stimuli of a distributed haptic device feel rougher."""
