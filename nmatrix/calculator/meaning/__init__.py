"""What values are and where: spaces and kinds, and the rules that operators and functions keep."""
