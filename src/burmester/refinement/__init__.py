"""The refinement of whole linkages: what is minimised, under which constraints, from where."""
