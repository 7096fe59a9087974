"""Lessons: the rules derived and proved; the only importers of SymPy."""
