"""Linear tissue: the section as a mesh, its stiffness, and that condensed to the skin in contact and the receptors."""
