"""One page with sliders: wrong normals beside right ones, by the shaders that nmatrix prints."""
