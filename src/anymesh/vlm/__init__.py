"""Vision-language models: the questions with their prompts, clients, budget, cache, replay, transcript, and answerers."""
