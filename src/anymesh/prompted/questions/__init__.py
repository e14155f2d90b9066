"""The questions, each with its pictures, text, schema and check."""
