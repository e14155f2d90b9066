"""Stage C (paper, 3.4): complete hidden and missing geometry, then textures."""
