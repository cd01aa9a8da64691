"""The recruiting rule over a scene: who breaks it, and the scene in which nobody does."""

from collections.abc import Iterable
from dataclasses import replace

from usdmotion.cast import Cast, Character
from usdmotion.recruiting import Claim, Parents, Violation, mend, violations
from usdmotion.scene import Edit, Scene


def broken(scene: Scene) -> list[Violation]:
    """Return every pair of constraints that breaks the rule, skeleton by skeleton."""
    return [
        violation
        for character in scene.characters
        for violation in violations(_parents(character), _claims(scene, character))
    ]


def mended(scene: Scene) -> Scene:
    """Return the scene with the fewest joints recruited in addition that make it keep the rule.

    A constraint only ever recruits joints of its own skeleton.
    """
    recruits: dict[str, tuple[str, ...]] = {}
    for character in scene.characters:
        parents, claims = _parents(character), _claims(scene, character)
        own = {each.path for each in scene.constraints if each.skeleton == character.path}
        for claim, better in zip(claims, mend(parents, claims), strict=True):
            if claim.name in own and better.recruits != claim.recruits:
                recruits[claim.name] = tuple(filter(better.recruits.__contains__, parents))
    return replace(scene, edits=tuple(_recruiting(edit, recruits) for edit in scene.edits))


def sentence(violation: Violation) -> str:
    """Return what is wrong and what would mend it."""
    joints = ", ".join(violation.joints)
    return (
        f"<{violation.low}> moves joints above <{violation.high}> that the latter may not move "
        f"although it ranks higher: let <{violation.high}> recruit {joints}, or use "
        "--mend-recruiting"
    )


def _parents(character: Character) -> Parents:
    skeleton = character.skeleton
    return {
        token: skeleton.joints[parent] if parent >= 0 else None
        for token, parent in zip(skeleton.joints, skeleton.parents, strict=True)
    }


def _claims(scene: Scene, character: Character) -> list[Claim]:
    """Return what each constraint moves and depends on among the joints of one character."""
    # One frame tells which joints there are, however long the clip is.
    cast = Cast.of([each.during(slice(0, 1)) for each in scene.characters])
    return [
        Claim(
            name=constraint.path,
            priority=constraint.priority,
            effectors=_tokens(cast, character, constraint.movable(cast)),
            recruits=_tokens(cast, character, constraint.recruited(cast)),
        )
        for constraint in scene.constraints
    ]


def _tokens(cast: Cast, character: Character, nodes: Iterable[int]) -> frozenset[str]:
    joints = (cast.joints[node] for node in nodes)
    return frozenset(token for path, token in joints if path == character.path and token)


def _recruiting(edit: Edit, recruits: dict[str, tuple[str, ...]]) -> Edit:
    constraints = tuple(
        replace(each, recruits=recruits[each.path]) if each.path in recruits else each
        for each in edit.constraints
    )
    return replace(edit, constraints=constraints)
