"""What people and programs type or paste, as exact numbers and matrices."""
