"""Question banks: exercises for a learning platform, which grades them by itself."""
