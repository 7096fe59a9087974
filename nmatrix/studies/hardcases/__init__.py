"""The hard cases: inputs with exact answers, and everyone who tries."""
