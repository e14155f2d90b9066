"""Carts, trolleys, prams and carriages."""
