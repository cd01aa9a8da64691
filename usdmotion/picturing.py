"""Pictures of a stage, from file to file."""
