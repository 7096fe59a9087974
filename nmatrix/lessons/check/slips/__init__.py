"""Each known mistake as one change of one stage of the computation."""
