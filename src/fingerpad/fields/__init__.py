"""Full fields of the section: displacement, strain and stress of solved states, for figures and ParaView."""
