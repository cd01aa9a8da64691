"""The stages that the project makes itself."""
