"""One page to turn and drag: wrong normals beside right ones, by the printed shaders."""
