"""Saved results on disk, used by `run_folder`."""
