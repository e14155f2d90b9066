"""What simulators, viewers and validators hold of our files, compared with asset.json by number."""
