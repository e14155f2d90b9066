"""External models other than vision-language models: SAM, HoloPart and Meshy, each behind a small protocol."""
