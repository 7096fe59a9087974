"""Scenes: worlds, cameras, lenses, lights, materials, and the files that they come from."""
