"""Proof images: each a picture whose claim is a number, and the numbers beside it.

A proof is a function from `ProofSettings` to a `Proof`, found by its name in the catalogue.
"""
