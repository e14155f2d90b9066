"""Applications of the pipeline (paper, section 4.2)."""
