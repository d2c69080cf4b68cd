"""Reading and drawing the results of scree."""
