"""The output folder of a run: stages kept with their keys, files written atomically."""
