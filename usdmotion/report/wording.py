"""How a report words numbers and kinds."""


def amount(value: float, unit: str) -> str:
    """Return a number in `m`, `deg` or another unit as people read it: millimetres, degrees."""
    if unit not in ("m", "deg"):
        return f"{value:.0f} {unit}" if value >= 100.0 else f"{value:.3g} {unit}"
    if unit == "deg":
        return f"{value:.3g}°" if value >= 0.001 or value == 0.0 else "under 0.001°"
    millimetres = value * 1e3
    if 0.0 < millimetres < 0.001:
        return "under 0.001 mm"
    decimals = next((n for n, top in ((3, 1.0), (2, 10.0), (1, 100.0)) if millimetres < top), 0)
    return f"{millimetres:.{decimals}f} mm"


def kind_of(schema: str) -> str:
    """Return the name of a constraint kind without what all of them share."""
    return schema.removeprefix("Motion").removesuffix("Constraint")
