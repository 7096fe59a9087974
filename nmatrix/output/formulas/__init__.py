"""One formula in every notation: a printer for each, all of the same tree."""
