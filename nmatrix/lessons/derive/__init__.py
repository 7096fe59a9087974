"""Derivations, each step proved by SymPy: the only room that imports it."""
