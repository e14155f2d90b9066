"""Who answers: a model, files, a recording, or a reference."""
