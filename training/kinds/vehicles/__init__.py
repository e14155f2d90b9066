"""Cars, lorries, buses, motorcycles and bicycles."""
