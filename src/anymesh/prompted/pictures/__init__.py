"""Draw the pictures of questions: marks, points, arrows, motions."""
