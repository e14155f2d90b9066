"""What is written with OpenUSD."""
