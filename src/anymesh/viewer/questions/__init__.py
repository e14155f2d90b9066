"""Questions that a person answers on the live page, on the object itself."""
