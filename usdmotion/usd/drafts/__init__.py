"""What is made for a stage that is open: whole first, then put into its edit target at once."""

from usdmotion.usd.drafts.draft import Draft, drawn_on
from usdmotion.usd.drafts.moving import move_prims
from usdmotion.usd.drafts.targets import called

__all__ = ["Draft", "called", "drawn_on", "move_prims"]
