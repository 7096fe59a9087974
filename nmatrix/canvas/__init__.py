"""Pictures made of marks: themes, text, arrows, glyphs and diagrams, written as pixels or vectors.

A picture is a list of frozen marks in units of its own; its height is 900. Nothing here knows the
rasterizer, a scene or NumPy: charts, proofs, handouts and the explorer share one look.
"""
