"""An independent solver: decks in Abaqus keywords, CalculiX run on them, and how far it and fingerpad are apart."""
