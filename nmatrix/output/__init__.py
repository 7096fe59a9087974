"""Every way to write a report: one writer per format over one document model."""

from nmatrix.output.options import Charset, Colour, OutputOptions
from nmatrix.output.write import write

__all__ = ["Charset", "Colour", "OutputOptions", "write"]
