"""Triangles to samples: clip, project, cover, see, interpolate; no light is known here.

Corners are whole numbers of 1/256 sample, so that coverage is exact; depth and triangle share one
integer key, so that no order of triangles matters; every sum is made in one order, so that tiles
and stripes change no bit.
"""
