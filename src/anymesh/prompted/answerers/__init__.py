"""Who answers: a model, files, a replay, or a reference."""
