"""Exercises: seeded for each student, with exact keys and the wrong answers that are expected."""
