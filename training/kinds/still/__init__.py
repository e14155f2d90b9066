"""Plants, figures, lamps, food: objects of which nothing moves."""
