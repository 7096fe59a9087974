"""Normal maps: normals that an image turns, given along tangent t, bitangent b and normal n.

Tangents are vectors and move by A; normals move by its inverse transpose. t·n = 0 survives only
so. They are brought to true lengths before they are added, and the sum goes back as a normal.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.raster.shading.space import Measure, dot, length

Array = NDArray[Any]


def bumped(normals: Array, tangents: Array, signs: Array, texels: Array, measure: Measure) -> Array:
    """Return normals (3, m), of any length, that a normal map makes of interpolated ones.

    Parameters
    ----------
    normals, tangents
        (3, m) in the shading space.
    signs
        (1, m) which way the bitangent b = ±(n × t) points: as the mesh says, times the sign of
        the determinant of the map to the space, since a mirror turns a cross product around.
    texels
        (3, m) levels of the map in [0, 1]; ½ ½ 1 leaves the normal as it is.

    Examples
    --------
    >>> up, east, plus = np.array([[0.0], [0], [1]]), np.array([[1.0], [0], [0]]), np.ones((1, 1))
    >>> bumped(up, east, plus, np.array([[0.5], [0.5], [1]]), Measure()).ravel().tolist()
    [0.0, 0.0, 1.0]
    """
    n = _unit(measure.normal_in_world(normals))
    t = measure.vector_in_world(tangents)
    t = _unit(t - n * dot(n, t))
    b = np.cross(n, t, axis=0) * signs
    x, y, z = texels * 2.0 - 1.0
    return measure.normal_from_world(x * t + y * b + z * n)


def _unit(vectors: Array) -> Array:
    long = length(vectors)
    return np.divide(vectors, long, out=np.zeros_like(vectors), where=long > 0)
