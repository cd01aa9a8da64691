"""What there is to look at on a stage, as prims with the purpose guide."""

from usdmotion.usd.guides.contacts import author_contact_guides

__all__ = ["author_contact_guides"]
