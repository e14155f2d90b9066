"""Reading of mesh files, their checks, and placement in the asset frame."""

from anymesh.loading.load import LoadedMesh, load_mesh
from anymesh.loading.place import PlacedMesh, place_mesh

__all__ = ["LoadedMesh", "PlacedMesh", "load_mesh", "place_mesh"]
