"""Clients of vision-language models: names, providers, retries, budget."""
