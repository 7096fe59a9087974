"""Triangles: shapes, mesh files, tangents, shells."""
