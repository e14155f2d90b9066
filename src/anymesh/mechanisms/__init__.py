"""Mechanisms of joints: springs, catches and detents, chosen by kind."""
