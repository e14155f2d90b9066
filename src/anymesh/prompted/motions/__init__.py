"""Stage B from answers: candidate points, motions to choose from, and how answers and geometry are weighed."""
