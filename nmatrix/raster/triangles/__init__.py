"""Triangles to samples: clip, project, cover, see, interpolate; no light is known here."""
