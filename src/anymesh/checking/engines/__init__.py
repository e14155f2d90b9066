"""The simulators that can drive an asset, one file each, and the neutral robot that they and the checks read."""
