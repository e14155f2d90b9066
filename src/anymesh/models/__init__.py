"""External models: vision-language models and mask proposers, each behind a small protocol."""
