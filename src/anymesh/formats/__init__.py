"""Readers of formats other than those of the core, which finds them by name; native ones run in child processes."""
