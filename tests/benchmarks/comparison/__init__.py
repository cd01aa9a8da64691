"""Our solver beside mink, pink and placo: one body, one clip, the same tasks, one tolerance."""
