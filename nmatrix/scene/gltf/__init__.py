"""glTF files: nodes, meshes, cameras, lights and materials."""
