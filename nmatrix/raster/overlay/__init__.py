"""Marks of the world over a picture: lines on meshes, tacks for normals, lamps, axes, the eye."""
