"""`python -m usdmotion`."""

from usdmotion.cli import main

main()
