"""What is made for a stage that is open: whole first, then put into its edit target at once."""

from usdmotion.usd.drafts.draft import Draft, drawn_on

__all__ = ["Draft", "drawn_on"]
