"""Data types of the package: frozen, numpy only, validated when constructed."""

from anymesh.types.asset import Asset, Source
from anymesh.types.exchange import Exchange, Picture
from anymesh.types.joints import Joint
from anymesh.types.mesh import Material, Mesh, Node, Texture
from anymesh.types.motion import MOVING, Handle, JointType, Motion, Sweep
from anymesh.types.parts import Part, Segmentation
from anymesh.types.shapes import Box, Cylinder, Hull, Shape

__all__ = [
    "MOVING",
    "Asset",
    "Box",
    "Cylinder",
    "Exchange",
    "Handle",
    "Hull",
    "Joint",
    "JointType",
    "Material",
    "Mesh",
    "Motion",
    "Node",
    "Part",
    "Picture",
    "Segmentation",
    "Shape",
    "Source",
    "Sweep",
    "Texture",
]
