"""The detector as the host sees it (2006)."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from usdmotion import Contact, Detected, NoisePattern, OptionError, Search
from usdmotion_contacts.displacements import displacements
from usdmotion_contacts.estimate import estimate
from usdmotion_contacts.instants import at_rest
from usdmotion_contacts.pattern import is_taught, pattern_of, taught
from usdmotion_contacts.places import places
from usdmotion_contacts.projection import SigmaEpsilon, project
from usdmotion_contacts.settling import settle

KINDS = ("space",)


@dataclass(frozen=True)
class ContactDetector:
    """Finds where an object is stationary, or turns about a line or a point, in spite of noise."""

    name: ClassVar[str] = "contacts"

    def detect(self, search: Search) -> Detected:
        """Return what an object obeys.

        Raises:
            OptionError: It cannot look for one of the kinds; the sentence lists what it can.
        """
        for kind in search.kinds:
            if kind not in KINDS:
                raise OptionError(
                    f"the detector 'contacts' cannot look for '{kind}'; it looks for "
                    + ", ".join(KINDS)
                )
        points = project(displacements(search))
        pattern, notes = _pattern(search, points)
        contacts = _spaces(search, points, pattern)
        return Detected(tuple(sorted(contacts, key=lambda each: each.start)), pattern, tuple(notes))


def _pattern(search: Search, points: SigmaEpsilon) -> tuple[NoisePattern, list[str]]:
    """Return the noise pattern of the templates, else the one given, else an estimated one."""
    noises, notes = taught(search, points)
    if is_taught(noises):
        return pattern_of(noises, None), notes
    otherwise = search.pattern or estimate(search, points)
    return (pattern_of(noises, otherwise) if noises else otherwise), notes


def _spaces(search: Search, points: SigmaEpsilon, pattern: NoisePattern) -> list[Contact]:
    groups, owners = places(search, points.displacements, at_rest(search, points, pattern))
    nothing = np.zeros((len(groups.into), 3))
    return settle(search, "space", groups, owners, nothing, nothing)
