"""What the pipeline is put to (paper, 4.2); each application imports the core's public surface only."""
