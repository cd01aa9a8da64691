"""The words that riggers use for the joints of a body.

A word counts only where it is all that a name says beside side and number, so twist and share
joints, ends, helpers and props are no parts. Where a word may mean several joints, the chain that
it stands in decides; the numbers say how much each meaning counts.
"""

from collections.abc import Mapping
from dataclasses import dataclass

from usdmotion.humanoid.parts import ARM, LEG

Meanings = Mapping[str, float]
"""What a word may mean, by the name of the part without its side, and how much that counts."""


@dataclass(frozen=True)
class Limb:
    """An arm or a leg: a chain of parts, and the words for them."""

    chain: tuple[str, ...]
    """Parts from the trunk out, without their side."""
    needed: tuple[str, ...]
    """Those that it has to have."""
    words: Mapping[str, Meanings]
    series: str
    """The word that names the whole limb where its joints are only numbered."""
    series_means: Mapping[int, tuple[str, ...]]
    """What so many joints in a row of that word are."""


def _meaning(part: str, weight: float, words: str) -> dict[str, Meanings]:
    return {word: {part: weight} for word in words.split()}


_CLAVICLE, _SHOULDER, _ELBOW, _WRIST = ARM
_HIP, _KNEE, _ANKLE, _TOE = LEG

ARM_LIMB = Limb(
    chain=ARM,
    needed=ARM[1:],
    words={
        **_meaning(_CLAVICLE, 2.0, "clavicle collar collarbone clav clavicula sternoclavicular"),
        **_meaning(_SHOULDER, 3.0, "upperarm uparm armupper humerus shldrbend"),
        **_meaning(_ELBOW, 3.0, "elbow forearm lowerarm lowarm loarm armlower"),
        **_meaning(_ELBOW, 3.0, "radius ulna forearmbend"),
        **_meaning(_WRIST, 3.0, "wrist hand radiocarpal"),
        "arm": {_SHOULDER: 2.0, _ELBOW: 1.0},
        "shoulder": {_SHOULDER: 1.0, _CLAVICLE: 0.5},
        "shldr": {_SHOULDER: 1.0, _CLAVICLE: 0.5},
    },
    series="arm",
    series_means={3: ARM[1:]},
)

LEG_LIMB = Limb(
    chain=LEG,
    needed=LEG[:3],
    words={
        **_meaning(_HIP, 3.0, "thigh upleg upperleg legupper femur thighbend"),
        **_meaning(_KNEE, 3.0, "knee calf shin shank tibia lowerleg lowleg loleg leglower"),
        **_meaning(_ANKLE, 3.0, "ankle talocrural"),
        **_meaning(_TOE, 2.0, "toe toes toebase ball forefoot metatarsophalangeal"),
        "foot": {_ANKLE: 3.0, _TOE: 1.0},
        "hip": {_HIP: 2.0},
        "hipjoint": {_HIP: 1.0},
        "leg": {_HIP: 1.0, _KNEE: 1.0},
    },
    series="leg",
    series_means={3: LEG[:3], 4: LEG},
)

PELVIS = frozenset({"pelvis", "hips", "hip"})
"""Words for the joint that carries legs and trunk, where they say no side."""
HEAD = frozenset({"head", "skull", "skullbase"})
NECK = frozenset({"neck"})

DIGITS = {
    **dict.fromkeys(("thumb", "big"), 1),
    **dict.fromkeys(("index",), 2),
    **dict.fromkeys(("middle", "mid"), 3),
    **dict.fromkeys(("ring",), 4),
    **dict.fromkeys(("pinky", "pinkie", "little"), 5),
}
"""Words for fingers and toes; they may stand beside others."""
PALM = frozenset({"metacarpal", "palm", "in"})
"""Words that say of a joint of a finger that it is in the palm."""

INHUMAN = frozenset({"tail", "wing", "paw", "hoof", "tentacle", "beak", "proboscis"})
"""Words for what no human body has."""
INHUMAN_HEAD = frozenset({"trunk", "snout", "mane"})
"""The same, where they hang on a head."""

NOISE = frozenset({"joint", "jnt", "jt", "bone", "bn", "def", "skeleton", "skel", "rig", "c"})
"""Words that say nothing."""

KNOWN = frozenset({*ARM_LIMB.words, *LEG_LIMB.words, *PELVIS, *HEAD, *NECK, *DIGITS})
"""All the words that may be a name by themselves."""
