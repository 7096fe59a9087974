"""The functions of the calculator, by name: what each takes, does, and how one writes it."""

from nmatrix.calculator.functions import (
    camera,
    elimination,
    maps,
    matrices,
    numeric,
    places,
    rotations,
    spectral,
    vectors,
)
from nmatrix.calculator.functions.function import Function

FUNCTIONS: dict[str, Function] = {
    **matrices.FUNCTIONS,
    **elimination.FUNCTIONS,
    **spectral.FUNCTIONS,
    **vectors.FUNCTIONS,
    **places.FUNCTIONS,
    **numeric.FUNCTIONS,
    **rotations.FUNCTIONS,
    **maps.FUNCTIONS,
    **camera.FUNCTIONS,
}
