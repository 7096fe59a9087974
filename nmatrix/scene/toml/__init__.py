"""Scene files of our own: tables to a scene, and what is wrong with them."""
