"""The matrix calculator: a closed grammar over exact numbers, and sessions of statements."""

# What stands before a statement, and before each line that goes on with it.
PROMPT, MORE = "> ", "  "
