"""The paper's table 2: policies trained on plain objects, or on these and objects that went through the pipeline."""
