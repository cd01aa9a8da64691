"""Events as prims, which a person can see in the hierarchy, move and switch off."""

from collections import Counter
from collections.abc import Sequence

from pxr import Sdf, Tf, Usd, UsdGeom

from usdmotion.capture import Event


def author_events(
    stage: Usd.Stage, path: str, events: Sequence[Event], rate: float, first: float
) -> None:
    """Author one Scope for each event.

    Its time is a `timecode`, so that it goes along when a reference shifts or stretches the clip.

    Args:
        stage: Where.
        path: Path of what they are put under.
        events: What happened.
        rate: Time codes per second.
        first: Time code at 0 s.
    """
    counts: Counter[str] = Counter()
    for event in events:
        words = f"{event.context} {event.label}".split()
        name = Tf.MakeValidIdentifier("".join(word[:1].upper() + word[1:] for word in words))
        counts[name] += 1
        prim = UsdGeom.Scope.Define(stage, f"{path}/{name}{counts[name]}").GetPrim()
        kinds = Sdf.ValueTypeNames
        for attribute, kind, value in (
            ("label", kinds.String, event.label),
            ("context", kinds.String, event.context),
            ("time", kinds.TimeCode, Sdf.TimeCode(first + event.time * rate)),
        ):
            prim.CreateAttribute(f"usdmotion:{attribute}", kind, False, Sdf.VariabilityUniform).Set(
                value
            )
