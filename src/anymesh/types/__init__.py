"""Data types of the package: frozen, numpy only, validated when constructed."""

from anymesh.types.asset import Asset, Part, ProposedJoint, Segmentation, Source
from anymesh.types.brief import Brief
from anymesh.types.exchange import Exchange, Picture
from anymesh.types.mesh import Box, Cylinder, Hull, Material, Mesh, Node, Shape, Texture
from anymesh.types.motion import MOVING, Handle, Joint, JointType, KnownJoint, Loop, Mimic, Motion, StatedJoint, Sweep

__all__ = [
    "MOVING",
    "Asset",
    "Box",
    "Brief",
    "Cylinder",
    "Exchange",
    "Handle",
    "Hull",
    "Joint",
    "JointType",
    "KnownJoint",
    "Loop",
    "Material",
    "Mesh",
    "Mimic",
    "Motion",
    "Node",
    "Part",
    "Picture",
    "ProposedJoint",
    "Segmentation",
    "Shape",
    "Source",
    "StatedJoint",
    "Sweep",
    "Texture",
]
