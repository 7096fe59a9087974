"""From a line of text to its tree, or to the caret under a fault."""
