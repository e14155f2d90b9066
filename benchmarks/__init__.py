"""Scripts that measure the package; each is run as `python -m benchmarks.NAME` and names its options with --help."""
