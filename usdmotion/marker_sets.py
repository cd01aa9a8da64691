"""What the labels of markers say about the body: which of them ride on one segment.

Plug-in-Gait's names, which most full-body sets keep, and those of its lower-body relatives. Model
and marker placement: Vicon, "Plug-in Gait Reference Guide"; Davis, Õunpuu, Tyburski & Gage, "A gait
analysis data collection and reduction technique", Human Movement Science 10 (1991).
"""

import re
from collections.abc import Sequence

_TRUNK = {
    "Head": ("LFHD", "RFHD", "LBHD", "RBHD"),
    "Thorax": ("C7", "T10", "CLAV", "STRN"),
    "Pelvis": ("LASI", "RASI", "LPSI", "RPSI", "SACR"),
}
_LIMBS = {
    "Shank": ("KNE", "TIB", "ANK"),
    "Foot": ("ANK", "HEE", "TOE"),
    "Forearm": ("ELB", "WRA", "WRB"),
    "Hand": ("WRA", "WRB", "FIN"),
}
_SAME = {"VSAC": "SACR", "SACRUM": "SACR", "IJ": "CLAV", "PX": "STRN"}
"""Other names of the same places, without what is no letter or digit."""
_SAME_ASIDE = {
    **{"ASIS": "ASI", "PSIS": "PSI", "BAR1": "THI", "KNEE": "KNE", "KNEE1": "KNE", "SHA": "TIB"},
    **{"BAR2": "TIB", "ANKLE": "ANK", "MALL": "ANK", "HEEL": "HEE", "MET": "TOE"},
    **{"SHOULD": "SHO", "SHOULDER": "SHO", "ELBOW": "ELB", "WRIST": "WRI"},
}
"""The same after an L or R."""
_ASIDE = "ASI PSI THI KNE TIB ANK HEE TOE SHO UPA ELB FRA WRA WRB WRI FIN FHD BHD BAK".split()
"""Places that are there on both sides, after an L or R."""
_COPY = re.compile(r"_\d+$")
_NUMBERED = re.compile(r"(.*\D)0*(\d+)")
_MOST = 6
"""More numbers than these count all the markers, not those of a segment."""


def subjects(labels: Sequence[str]) -> dict[str, list[str]]:
    """Return labels by the subject that they begin with: `Matt:LASI` is Matt's, `LASI` nobody's."""
    found: dict[str, list[str]] = {}
    for label in labels:
        found.setdefault(label.rpartition(":")[0].strip(), []).append(label)
    return found


def plain(label: str) -> str:
    """Return a label without the subject it begins with: `Matt:LASI` is `LASI`."""
    return label.rpartition(":")[2].strip()


def places(labels: Sequence[str]) -> dict[str, str]:
    """Return the label that stands at each place of Plug-in-Gait, the first where there are more.

    The names of the places are Plug-in-Gait's, whatever the file calls them.
    """
    found: dict[str, str] = {}
    for label in labels:
        name = plain(label)
        if not _COPY.search(name):
            found.setdefault(_place(name), label)
    return found


def _place(name: str) -> str:
    bare = "".join(letter for letter in name.upper() if letter.isalnum())
    if bare in _SAME:
        return _SAME[bare]
    core = _SAME_ASIDE.get(bare[1:], bare[1:])
    if bare[:1] in ("L", "R") and core in _ASIDE:
        return bare[0] + core
    return name.upper()


def segments_of(labels: Sequence[str]) -> dict[str, tuple[str, ...]]:
    """Return the labels on each segment of a body that has three or more, by its name.

    A marker on the axis of a joint rides on both segments. Of labels that nobody knows, a few that
    are numbered from 1 on (`RFT1`, `RFT2`, `RFT3`) are taken to be on one segment. Segments of a
    second subject have its name before theirs.
    """
    found: dict[str, tuple[str, ...]] = {}
    for subject, own in subjects(labels).items():
        whose = re.sub(r"\W", "_", subject)
        for name, riding in _segments_of_one(own).items():
            found[f"{whose}_{name}" if name in found else name] = riding
    return {name: riding for name, riding in found.items() if name.isidentifier()}


def _segments_of_one(labels: Sequence[str]) -> dict[str, tuple[str, ...]]:
    sides = (("Left", "L"), ("Right", "R"))
    segments = dict(_TRUNK)
    for limb, marks in _LIMBS.items():
        segments |= {f"{side}{limb}": tuple(sign + mark for mark in marks) for side, sign in sides}
    every = places(labels)
    wanted = {each for riding in segments.values() for each in riding}
    known = {mark: label for mark, label in every.items() if mark in wanted}
    present = {
        name: tuple(known[mark] for mark in riding if mark in known)
        for name, riding in segments.items()
    }
    found = {name: riding for name, riding in present.items() if len(riding) >= 3}
    return found | _numbered([label for label in labels if label not in known.values()])


def _numbered(labels: Sequence[str]) -> dict[str, tuple[str, ...]]:
    """Return labels that differ in a number only, from 1 on, by what they have in common."""
    series: dict[str, list[tuple[int, str]]] = {}
    for label in labels:
        parts = _NUMBERED.fullmatch(plain(label))
        if parts:
            series.setdefault(parts[1].lower(), []).append((int(parts[2]), label))
    found = {}
    for members in series.values():
        numbers = sorted(number for number, _ in members)
        if 3 <= len(members) <= _MOST and numbers == list(range(1, len(members) + 1)):
            stem = plain(members[0][1]).rstrip("0123456789_ ")
            found[stem] = tuple(label for _, label in members)
    return {name: riding for name, riding in found.items() if name.isidentifier()}
