"""`inspect`: what the maps of a file's nodes are, file by file, and the report about them."""
