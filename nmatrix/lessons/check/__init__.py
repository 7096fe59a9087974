"""Say which mistake an answer holds: the right answer, every known wrong one, and a comparison."""
