"""Training of the shipped classifiers: objects to learn from, their rows, and the scripts that fit, measure and explain."""
