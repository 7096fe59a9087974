"""The hard cases: inputs with exact answers, and the methods that are judged on them."""
