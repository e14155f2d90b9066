"""What the pipeline is used for: each package here needs its own extra and imports only what lies below."""
