"""Summary sentences and recommendations derived from the measurements."""
import html

from report_data import number, timed
from report_format import listed, percent, plain, ratio

kEverywhere = 0.01  # largest relative error for "everywhere"
kGood = 0.001  # largest share of pixels with an error above 1 % for a recommended method


def code(method: str) -> str:
    return f"<code>{html.escape(method)}</code>"


def bold(name: str) -> str:
    return f"<b>{html.escape(name)}</b>"


def cost_words(row: dict, base: str = "schlick") -> str:
    """Describes the time relative to schlick; a difference is stated only if it is significant."""
    relative = row.get("ratioToSchlick") or {}
    median, low, high = (number(relative, name) for name in ("median", "low", "high"))
    if row["method"] == base:
        return "is the baseline"
    if median is None or low is None or high is None:
        return f"was not timed against {code(base)}"
    if base in (row.get("noSignificantDifference") or []) or low <= 1 <= high:
        return f"shows no significant difference in time from {code(base)}"
    return f"takes {ratio(median)} times as long as {code(base)} ({ratio(low)} to {ratio(high)})"


def verdict(row: dict, base: str = "schlick") -> str:
    """"faster", "slower", "same" (no significant difference) or "" (not timed)."""
    relative = row.get("ratioToSchlick") or {} if row else {}
    low, high = number(relative, "low"), number(relative, "high")
    if low is None or high is None:
        return ""
    if base in (row.get("noSignificantDifference") or []) or low <= 1 <= high:
        return "same"
    return "faster" if high < 1 else "slower"


def mostly(wrong) -> str:
    if not wrong.location:
        return ""
    return ", in all parts of the image" if wrong.location.startswith("all") else f", mostly in {wrong.location}"


def first_sentence(wrong, polarization, visible=None) -> str:
    """Describes the effect of ignoring polarization. wrong: summary of the exact unpolarized method, None if it was
    not run; polarization: the same without pixels that are wrong with full polarization too (rounding at edges);
    visible: mean FLIP of the method's image, 0 to 1."""
    if wrong is None:
        return f"{code('fresnel')} was not run on this scene: the effect of polarization is unknown."
    if wrong.largest <= kEverywhere:
        return (f"In this scene {code('fresnel')} is within {percent(wrong.largest)} of the reference everywhere: "
                "polarization may be left out.")
    if polarization.share == 0:
        return (f"In this scene {code('fresnel')} has an error above 1 % only where {code('stokes')} has one too "
                f"({percent(wrong.share)} of the pixels, rounding at edges): polarization may be left out.")
    size = f"at most {percent(polarization.largest)}" if polarization.largest <= 1 else "in places above 100 %"
    flip = "" if visible is None else f"; the mean FLIP (0 to 1) is {plain(visible)}"
    return (f"In this scene polarization matters in {percent(polarization.share)} of the pixels"
            f"{mostly(polarization)}: there the error of {code('fresnel')}, which ignores polarization, is above 1 % of "
            f"the reference, {size}{flip}.")


def allowed_share(rows: list) -> float:
    """Returns the allowed share of pixels with an error above 1 %: 0.001, or 1.5 times the share of the best method
    if rounding at edges leaves more."""
    shares = [number(r, "error", "shareOver1Percent") for r in rows if r["status"] == "ok"]
    return max(kGood, 1.5 * min((s for s in shares if s is not None and s < 0.02), default=0))


def cheapest_good(rows: list):
    """Returns the fastest accurate row, and the accurate rows whose time shows no significant difference from it."""
    allowed = allowed_share(rows)
    good = sorted((r for r in rows if timed(r) and number(r, "error", "relRms") is not None
                   and number(r, "error", "shareOver1Percent") is not None
                   and r["error"]["shareOver1Percent"] <= allowed), key=lambda r: r["medianMs"])
    if not good:
        return None, []
    same = [r for r in good[1:] if r["method"] in (good[0].get("noSignificantDifference") or [])]
    return good[0], same


def second_sentence(group) -> str:
    """Recommends a method for each renderer, with its cost."""
    parts, allowed = [], kGood
    for renderer in group.renderers:
        rows = [r for r in group.rows if r["renderer"] == renderer]
        allowed = max(allowed, allowed_share(rows))
        best, same = cheapest_good(rows)
        if best is None:
            known = [r for r in rows if r["status"] == "ok" and number(r, "error", "relRms") is not None]
            if known:
                least = min(known, key=lambda r: r["error"]["relRms"])
                parts.append(f"on {html.escape(renderer)} no method reaches that; {code(least['method'])} is the most accurate")
            else:
                parts.append(f"on {html.escape(renderer)} nothing was rendered")
            continue
        # Among methods without a significant difference in time, recommend the most accurate.
        pick = min([best, *same], key=lambda r: r["error"]["relRms"])
        others = [code(r["method"]) for r in [best, *same] if r is not pick]
        text = f"on {html.escape(renderer)} use {code(pick['method'])}, which {cost_words(pick)}"
        if others:
            text += f" or {listed(others, 'or')}" if "no significant difference" in text else (
                f" and shows no significant difference in time from {listed(others, 'or')}")
        parts.append(text)
    return f"For an error above 1 % in at most {percent(allowed)} of the pixels, {'; '.join(parts)}."
