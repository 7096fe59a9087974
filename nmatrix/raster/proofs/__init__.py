"""Proof images: each a picture whose claim is a number, and the numbers beside it."""
