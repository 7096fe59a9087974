"""The functions of the calculator, by name: what each takes, does, and how one writes it."""

from nmatrix.calculator.functions import maps, matrices, numeric, places, vectors
from nmatrix.calculator.functions.function import Function

FUNCTIONS: dict[str, Function] = {
    **matrices.FUNCTIONS,
    **vectors.FUNCTIONS,
    **places.FUNCTIONS,
    **numeric.FUNCTIONS,
    **maps.FUNCTIONS,
}
