"""Reading of mesh files, their checks, and placement in the asset frame."""

from anymesh.loading.load import LoadedMesh, PlacedMesh, load_mesh, place_mesh

__all__ = ["LoadedMesh", "PlacedMesh", "load_mesh", "place_mesh"]
