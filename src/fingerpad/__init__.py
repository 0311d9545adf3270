"""fingerpad: predicts how rough a distributed haptic device feels."""
