"""Matrices, vectors and angles, exactly: floats are rationals, rounded once at the end."""
