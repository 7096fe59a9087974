"""The steps of a calculation as a person writes them on paper, each line from the one before."""
