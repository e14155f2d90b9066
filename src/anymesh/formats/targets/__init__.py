"""An asset as the loaders of other projects want it."""
