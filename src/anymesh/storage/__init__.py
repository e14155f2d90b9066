"""How results lie on disk, below `run_folder`."""
