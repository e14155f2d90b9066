"""Small kitchen appliances and kitchenware."""
