"""Numbers of every kind, values made of them, and the operators between them."""
