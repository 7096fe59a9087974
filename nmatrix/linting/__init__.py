"""Shaders read for their spaces: which vector is in which, and where two meet that must not."""
