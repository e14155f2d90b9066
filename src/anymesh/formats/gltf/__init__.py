"""glTF 2.0: its scene, geometry, materials and compressed data."""
