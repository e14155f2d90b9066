"""MJCF: the model of MuJoCo."""
