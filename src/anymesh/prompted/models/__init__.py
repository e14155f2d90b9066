"""Clients of vision-language models: providers, retries, budget, cache."""
