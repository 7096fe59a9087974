"""Lessons: rules are derived and proved, answers checked, exercises drawn."""
