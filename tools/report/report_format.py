"""Number formatting."""
import math


def plain(value, digits: int = 3) -> str:
    """Formats three significant digits, without an exponent from 0.0001 to 10 million."""
    if value is None:
        return "–"
    if value == 0:
        return "0"
    size = abs(value)
    if size < 1e-4 or size >= 1e7:
        mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
        superscript = str(int(exponent)).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
        return f"{mantissa} · 10{superscript}"
    decimals = max(0, digits - 1 - math.floor(math.log10(size)))
    return f"{value:,.{decimals}f}"


def percent(share) -> str:
    """Formats a share with two significant digits; a share above 0 is never printed as 0."""
    if share is None:
        return "–"
    value = 100 * share
    if value == 0:
        return "0 %"
    if abs(value) < 0.001:
        return "under 0.001 %"
    if 99.5 <= value < 100:
        return f"{math.floor(value * 10) / 10:.1f} %"
    decimals = max(0, 1 - math.floor(math.log10(abs(value))))
    return f"{value:,.{decimals}f} %"


def at_most(share) -> str:
    """Formats a share as a bound."""
    text = percent(share)
    return text if text.startswith("under") or share == 0 else f"at most {text}"


def ratio(value) -> str:
    return "–" if value is None else f"{value:.3f}"


def energy(value) -> str:
    return "–" if value is None else f"{value:.4f}"


def count(value) -> str:
    return "–" if value is None else f"{value:,.0f}" if value == int(value) else f"{value:,.2f}"


def interval(low, high) -> str:
    return "" if low is None or high is None else f"{ratio(low)} to {ratio(high)}"


def group_size(group) -> str:
    return f"{group.width} × {group.height}, depth {group.depth}"


def listed(names: list, last: str = "and") -> str:
    names = list(names)
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} {last} {names[-1]}" if names else ""
