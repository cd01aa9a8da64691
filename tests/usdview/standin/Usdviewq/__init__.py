"""A stand-in for the package of usdview, which is not in the wheels of USD: without any window."""
