"""The paper's method: questions about pictures, who answers them, and stages A and B from the answers."""
