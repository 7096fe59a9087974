"""A scene seen from any space: one matrix per space, and everything that follows from it."""
