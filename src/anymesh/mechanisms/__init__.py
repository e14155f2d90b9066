"""What joints resist with: friction, damping and limits, and springs, catches and detents, chosen by kind."""
