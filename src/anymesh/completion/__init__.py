"""Stage C (paper, 3.4): completion of shapes and creation of textures, from asset to asset."""
