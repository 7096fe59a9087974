"""Triangles: shapes, mesh files, tangents, watertightness."""
