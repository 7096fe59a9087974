"""GLSL: the lines of each effect, and the one generator that makes programs of them.

A `Shaded` says what is drawn; a sheet of `nmatrix space` and each body of a plan become one.
`effects` holds the lines, `program` puts them in order and declares what they read.
"""
