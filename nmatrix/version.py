"""The version, a literal: reading package metadata would cost more than a matrix."""

__version__ = "0.1.0"
