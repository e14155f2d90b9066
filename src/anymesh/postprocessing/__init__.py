"""Stage C (3.4): shapes completed, textures made; asset to asset."""
