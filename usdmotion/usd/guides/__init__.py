"""What there is to look at on a stage, as prims with the purpose guide."""

from usdmotion.usd.guides.contacts import author_contact_guides, author_contact_marks
from usdmotion.usd.guides.marks import read_contact_marks
from usdmotion.usd.guides.scenes import author_guides

__all__ = [
    "author_contact_guides",
    "author_contact_marks",
    "author_guides",
    "read_contact_marks",
]
