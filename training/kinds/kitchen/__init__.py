"""Fitted kitchens and large appliances."""
