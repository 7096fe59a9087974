"""The matrix calculator: a closed grammar over exact fractions, with the steps on request."""
