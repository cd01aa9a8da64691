"""The verbs on a stage that is open: what they make goes to its edit target, and not to disk."""
