"""Shading: samples to colours, in any space whose lengths the metric makes true.

A `Surface` is one body's two shaders; it asks its `Lighting` for light, and `ShadingSpace` for
every matrix, each rounded once.
"""
