"""Street furniture, shop and ticket machines."""
