"""Applications of the pipeline (paper, 4.2); each imports only the public interface of the core."""
