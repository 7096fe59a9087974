"""Studies: what accuracy costs in time, and which hard cases each method survives."""
