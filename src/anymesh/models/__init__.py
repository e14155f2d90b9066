"""Outside models: vision-language models and mask proposers, each behind one small protocol."""
