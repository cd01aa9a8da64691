"""Input that is noisy, cleaned before anything is asked of it (2004, section 7).

Outliers are replaced, what is left is low-passed gently, and contacts are preserved.
"""

from usdmotion.cleaning.account import Cleaning, Held, Replaced
from usdmotion.cleaning.inputs import cleaned

__all__ = ["Cleaning", "Held", "Replaced", "cleaned"]
