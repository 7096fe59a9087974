"""What a user describes: worlds, cameras, lights, lenses, and the files they come from."""
