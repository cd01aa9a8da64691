"""The parts of a body: H-Anim names of joints (ISO/IEC 19774-1:2019), as the schema lists them."""

_DIGITS = (2, 3, 4, 5)

SPINE = (*(f"vl{n}" for n in (5, 4, 3, 2, 1)), *(f"vt{n}" for n in range(12, 0, -1)))
"""The vertebrae of the back from the pelvis up."""
NECK = tuple(f"vc{n}" for n in range(7, 0, -1))
"""The vertebrae of the neck from the chest up."""

ARM = ("sternoclavicular", "shoulder", "elbow", "radiocarpal")
"""The chain of an arm without its side: clavicle, shoulder, elbow, wrist."""
LEG = ("hip", "knee", "talocrural", "metatarsophalangeal")
"""The chain of a leg without its side: hip, knee, ankle, toes."""
ANKLE, BALL = LEG[2:]
"""The joints of a foot that stand, without their side."""
FEET = tuple(f"{side}_{part}" for side in "lr" for part in (ANKLE, BALL))
"""Ankle and ball of the left foot, then of the right."""

_TARSUS = (
    "talocalcaneonavicular",
    *(f"cuneonavicular_{n}" for n in (1, 2, 3)),
    "calcaneuscuboid",
    "transversetarsal",
)
_CARPUS = (*(f"midcarpal_{n}" for n in (1, 2, 3)), "midcarpal_4_5")


def toe(digit: int) -> tuple[str, ...]:
    """Return the joints of a toe without its side, the big toe being 1, from the ankle on."""
    ends = ("",) if digit == 1 else ("proximal_", "distal_")
    joints = (
        "tarsometatarsal",
        "metatarsophalangeal",
        *(f"tarsal_{e}interphalangeal" for e in ends),
    )
    return tuple(f"{joint}_{digit}" for joint in joints)


def finger(digit: int) -> tuple[str, ...]:
    """Return the joints of a finger without its side, the thumb being 1, from the wrist on."""
    ends = ("",) if digit == 1 else ("proximal_", "distal_")
    joints = (
        "carpometacarpal",
        "metacarpophalangeal",
        *(f"carpal_{e}interphalangeal" for e in ends),
    )
    return tuple(f"{joint}_{digit}" for joint in joints)


def _leg(side: str) -> list[str]:
    whole_foot = ("tarsometatarsal", "metatarsophalangeal", "tarsal_interphalangeal")
    toes = [joint for digit in (1, *_DIGITS) for joint in toe(digit)]
    return [f"{side}_{joint}" for joint in (*LEG[:3], *whole_foot, *_TARSUS, *toes)]


def _arm(side: str) -> list[str]:
    chain = (ARM[0], "acromioclavicular", *ARM[1:])
    fingers = [joint for digit in (1, *_DIGITS) for joint in finger(digit)]
    return [f"{side}_{joint}" for joint in (*chain, *_CARPUS, *fingers)]


def _face() -> list[str]:
    eyes = [f"{side}_{of}_joint" for side in "lr" for of in ("eyelid", "eyeball", "eyebrow")]
    return ["temporomandibular", *eyes]


PARTS = (
    *("humanoid_root", "sacroiliac"),
    *(*_leg("l"), *_leg("r")),
    *(*SPINE, *NECK, "skullbase"),
    *_face(),
    *(*_arm("l"), *_arm("r")),
)
"""Every part, in the order of the schema."""

NEEDED = (
    *("humanoid_root", "skullbase"),
    *(f"{side}_{part}" for side in "lr" for part in (*ARM[1:], *LEG[:3])),
)
"""The parts that every human body has, whatever it was captured with; and some vertebra."""
