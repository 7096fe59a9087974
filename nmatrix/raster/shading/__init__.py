"""From samples to colours: shading spaces, lights, surfaces, shadows, textures."""
