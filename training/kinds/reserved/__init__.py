"""The reserved kinds, which nothing is trained or tuned on."""
