"""The rasterizer: clip, snap, cover, see, shade; every picture proves a statement."""
