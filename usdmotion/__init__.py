"""Make captured motion fit the shot, in USD, without touching the original."""
