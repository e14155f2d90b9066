"""Stage A from answers: numbered marks on pictures, and the faces that the chosen marks stand for."""
