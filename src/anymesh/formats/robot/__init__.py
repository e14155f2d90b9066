"""Writers of URDF, MJCF and SDFormat."""
