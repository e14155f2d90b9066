"""Electronic devices, controls, cameras and optics."""
