"""Parts on the live page: the selected part with its motions in pictures, and new parts made of faces that are clicked."""
