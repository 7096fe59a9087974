"""The rasterizer: scenes to pictures, in NumPy alone, each picture a proof of a statement.

A `LoadedScene` holds triangles and lights; a plan says which effects it calls for; `render` turns
the plan into surfaces and draws them. The rooms stand on one another: `triangles` (geometry to
samples), `shading` (samples to colours), `planning` (what need not be computed), `proofs`.
"""
