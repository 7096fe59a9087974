"""Sheets for a class: what stands on them, who gets which, and how they are all made."""
