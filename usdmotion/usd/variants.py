"""Alternatives on one prim, as USD has them."""

from collections.abc import Iterator
from contextlib import contextmanager

from pxr import Usd


@contextmanager
def variant(stage: Usd.Stage, path: str, variant_set: str, name: str) -> Iterator[None]:
    """Have what is authored under a prim meanwhile be one of its variants, and select it.

    Args:
        stage: Where, in its edit target.
        path: Path of the prim, which is there.
        variant_set: Name of the set, made where it is missing.
        name: Name of the variant, made where it is missing.
    """
    variants = stage.GetPrimAtPath(path).GetVariantSets().AddVariantSet(variant_set)
    variants.AddVariant(name)
    variants.SetVariantSelection(name)
    with variants.GetVariantEditContext():
        yield
