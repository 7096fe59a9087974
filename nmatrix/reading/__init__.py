"""Readers of what people and programs type or paste: exact numbers and matrices."""
