"""Every way to write a report: one writer per format over one document model."""

from nmatrix.output.write import Charset, Colour, OutputOptions, write

__all__ = ["Charset", "Colour", "OutputOptions", "write"]
