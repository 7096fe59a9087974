"""The judgement of an answer: the right one, every known wrong one, and a comparison."""
