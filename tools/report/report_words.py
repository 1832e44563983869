"""Sentences made from the numbers: what a person who has this scene should do."""
import html

from report_data import number, timed
from report_format import listed, percent, plain, ratio

kEverywhere = 0.01  # "everywhere" allows no pixel more than this
kGood = 0.001  # share of pixels that a recommended method may have off by more than 1 %


def code(method: str) -> str:
    return f"<code>{html.escape(method)}</code>"


def bold(name: str) -> str:
    return f"<b>{html.escape(name)}</b>"


def cost_words(row: dict, base: str = "schlick") -> str:
    """Time against schlick: a difference is named only where the rounds show one."""
    relative = row.get("ratioToSchlick") or {}
    median, low, high = (number(relative, name) for name in ("median", "low", "high"))
    if row["method"] == base:
        return "is the base that others are compared with"
    if median is None or low is None or high is None:
        return f"has no time against {code(base)}"
    if base in (row.get("indistinguishable") or []) or low <= 1 <= high:
        return f"cannot be told apart from {code(base)} in time"
    return f"takes {ratio(median)} times as long as {code(base)} ({ratio(low)} to {ratio(high)})"


def verdict(row: dict, base: str = "schlick") -> str:
    """"faster", "slower", "same" (cannot be told apart) or "" (no number)."""
    relative = row.get("ratioToSchlick") or {} if row else {}
    low, high = number(relative, "low"), number(relative, "high")
    if low is None or high is None:
        return ""
    if base in (row.get("indistinguishable") or []) or low <= 1 <= high:
        return "same"
    return "faster" if high < 1 else "slower"


def mostly(wrong) -> str:
    if not wrong.place:
        return ""
    return ", in all parts of the picture" if wrong.place.startswith("all") else f", mostly in {wrong.place}"


def first_sentence(wrong, polarization, visible=None) -> str:
    """What leaving polarization out does. wrong: of the exact unpolarized method, None where it was not run;
    polarization: the same without the pixels in which full polarization is off too (rounding at edges);
    visible: mean FLIP of the method's picture, 0 to 1."""
    if wrong is None:
        return f"{code('fresnel')} was not run on this scene: what polarization changes is not known."
    if wrong.largest <= kEverywhere:
        return (f"In this scene {code('fresnel')} is within {percent(wrong.largest)} of the reference everywhere: "
                "polarization may be left out.")
    if polarization.share == 0:
        return (f"In this scene {code('fresnel')} is off by more than 1 % only where {code('stokes')} is too "
                f"({percent(wrong.share)} of the pixels, rounding at edges): polarization may be left out.")
    size = f"by {percent(polarization.largest)} at most" if polarization.largest <= 1 else "in places by more than 100 %"
    seen = "" if visible is None else f"; to the eye (mean FLIP, 0 to 1) the picture is {plain(visible)} away"
    return (f"In this scene polarization matters in {percent(polarization.share)} of the pixels"
            f"{mostly(polarization)}: there {code('fresnel')}, which leaves it out, is off by more than 1 % of the "
            f"reference, {size}{seen}.")


def allowed_share(rows: list) -> float:
    """Share of pixels that a recommended method may have off by more than 1 %: one in a thousand, or half more
    than the best method has where rounding at edges leaves more."""
    shares = [number(r, "error", "shareOver1Percent") for r in rows if r["status"] == "ok"]
    return max(kGood, 1.5 * min((s for s in shares if s is not None and s < 0.02), default=0))


def cheapest_good(rows: list):
    """The fastest row with few enough pixels off, and the other good ones that its time cannot be told from."""
    allowed = allowed_share(rows)
    good = sorted((r for r in rows if timed(r) and number(r, "error", "relRms") is not None
                   and number(r, "error", "shareOver1Percent") is not None
                   and r["error"]["shareOver1Percent"] <= allowed), key=lambda r: r["medianMs"])
    if not good:
        return None, []
    same = [r for r in good[1:] if r["method"] in (good[0].get("indistinguishable") or [])]
    return good[0], same


def second_sentence(group) -> str:
    """Which method to take, and what it costs, on every renderer."""
    parts, allowed = [], kGood
    for renderer in group.renderers:
        rows = [r for r in group.rows if r["renderer"] == renderer]
        allowed = max(allowed, allowed_share(rows))
        best, same = cheapest_good(rows)
        if best is None:
            known = [r for r in rows if r["status"] == "ok" and number(r, "error", "relRms") is not None]
            if known:
                least = min(known, key=lambda r: r["error"]["relRms"])
                parts.append(f"on {html.escape(renderer)} no method reaches that, {code(least['method'])} comes nearest")
            else:
                parts.append(f"on {html.escape(renderer)} nothing was rendered")
            continue
        # Where several cannot be told apart in time the least wrong of them is the one to take.
        pick = min([best, *same], key=lambda r: r["error"]["relRms"])
        others = [code(r["method"]) for r in [best, *same] if r is not pick]
        text = f"on {html.escape(renderer)} take {code(pick['method'])}, which {cost_words(pick)}"
        if others:
            text += f", nor from {listed(others, 'or')}" if "cannot be told apart" in text else (
                f" and cannot be told apart from {listed(others, 'or')} in time")
        parts.append(text)
    return f"To have at most {percent(allowed)} of the pixels off by more than 1 %, {'; '.join(parts)}."
