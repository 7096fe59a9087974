"""Formulas as trees: read from the line that a person would type, written for eyes and ears."""
