"""Summary sentences and recommendations derived from the measurements."""
import html

from report_colours import kSignificantDoLP
from report_data import has_enough_rounds, kFewestRounds, number, timed
from report_format import at_most, listed, percent, plain, ratio

kEverywhere = 0.01  # largest relative error for "everywhere"
kRounding = 1e-5  # relative RMS error that an exact method has in float
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
    """"faster", "slower", "same" (no significant difference) or "" (not timed, or in too few rounds)."""
    relative = row.get("ratioToSchlick") or {} if row else {}
    low, high = number(relative, "low"), number(relative, "high")
    if low is None or high is None or not has_enough_rounds(row):
        return ""
    if base in (row.get("noSignificantDifference") or []) or low <= 1 <= high:
        return "same"
    return "faster" if high < 1 else "slower"


def mostly(wrong) -> str:
    if not wrong.location:
        return ""
    return ", in all parts of the image" if wrong.location.startswith("all") else f", mostly in {wrong.location}"


def filter_words(polarizer) -> str:
    """"without a filter", or the polarizer that the images were rendered behind."""
    return "without a filter" if polarizer is None else f"behind the polarizer at {plain(polarizer)}°"


def polarized_words(degrees, polarizer) -> str:
    """States what an image that needs no polarization does not show. degrees: (median, largest) DoLP of the light in
    front of any filter; None if unknown."""
    if degrees is None:
        return "Whether the light is polarized is unknown: the reference has no Stokes vectors."
    median, largest = degrees
    if largest < kSignificantDoLP:
        return "The light is unpolarized, so no filter changes that."
    return (f"{'Behind a filter' if polarizer is None else 'Behind another filter'}, and for DoLP, AoLP and mosaics, "
            f"polarization is needed: the DoLP is {percent(median)} in the median pixel and at most {percent(largest)}.")


def first_sentence(wrong, polarization, row, degrees, polarizer) -> str:
    """Describes the effect of ignoring polarization. wrong: summary of the exact unpolarized method, None if it was
    not run; polarization: the same without pixels that are wrong with full polarization too (rounding at edges);
    row: its measurements; degrees, polarizer: as in polarized_words."""
    if wrong is None:
        return f"{code('fresnel')} was not run on this scene: the effect of polarization is unknown."
    seen = filter_words(polarizer)
    share = number(row, "error", "shareOver1Percent")
    if wrong.largest <= kEverywhere:
        return (f"The intensity {seen} needs no polarization: the error of {code('fresnel')} is {at_most(wrong.largest)} "
                f"everywhere. {polarized_words(degrees, polarizer)}")
    if polarization.share == 0:
        return (f"The intensity {seen} needs no polarization: {code('fresnel')} has an error above 1 % only where "
                f"{code('stokes')} has one too ({percent(share)} of the pixels, rounding at edges). "
                f"{polarized_words(degrees, polarizer)}")
    size = f"at most {percent(polarization.largest)}" if polarization.largest <= 1 else "in places above 100 %"
    return (f"The intensity {seen} needs polarization: {code('fresnel')}, which ignores it, has an error above 1 % in "
            f"{percent(share)} of the pixels{mostly(polarization)}, {size}.")


def short_verdict(wrong, polarization, row, degrees, polarizer) -> str:
    """The first half of a scene's verdict, in a few words."""
    seen = filter_words(polarizer)
    if wrong is None:
        return "effect of polarization unknown"
    if wrong.largest <= kEverywhere or polarization.share == 0:
        if degrees is not None and degrees[1] >= kSignificantDoLP:
            return f"the intensity {seen} needs no polarization; DoLP, AoLP, mosaics and other filters do"
        return f"the intensity {seen} needs no polarization"
    return (f"without polarization {percent(number(row, 'error', 'shareOver1Percent'))} of the pixels are wrong by more "
            f"than 1 % ({seen})")


def few_rounds(rows: list) -> int:
    """Returns the number of rounds if it is too small to recommend a method, else 0."""
    rounds = max((len(r.get("samplesMs") or []) for r in rows), default=0)
    return rounds if 0 < rounds < kFewestRounds else 0


def more_rounds(rounds: int) -> str:
    return (f"{rounds} {'round is' if rounds == 1 else 'rounds are'} too few to recommend a method: at least "
            f"{kFewestRounds} are needed (<code>--rounds</code>)")


def short_recommendation(group) -> str:
    """The second half of a scene's verdict: per renderer the recommended method with its time."""
    if few_rounds(group.rows):
        return more_rounds(few_rounds(group.rows))
    parts = []
    for renderer in group.renderers:
        rows = [r for r in group.rows if r["renderer"] == renderer]
        pick, _ = recommended(rows)
        if pick is None:
            continue
        median, word = number(pick, "ratioToSchlick", "median"), verdict(pick)
        cost = "" if not word or pick["method"] == "schlick" else (
            f", in the time of {code('schlick')} within the spread" if word == "same" else
            f", {median:.2f} × the time of {code('schlick')}")
        parts.append(f"{code(pick['method'])} on {html.escape(renderer)}{cost}")
    return f"use {'; '.join(parts)}" if parts else "no method keeps 1 %"


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


def recommended(rows: list):
    """Returns the recommended row of one renderer, and the others that show no significant difference in time from the
    fastest accurate one: among these the most accurate is recommended."""
    best, same = cheapest_good(rows)
    if best is None:
        return None, []
    # Errors within 5 % of each other, or within the rounding of float, are equal: then the faster median is taken.
    least = max(1.05 * min(r["error"]["relRms"] for r in [best, *same]), kRounding)
    pick = min((r for r in [best, *same] if r["error"]["relRms"] <= least), key=lambda r: r["medianMs"])
    return pick, [r for r in [best, *same] if r is not pick]


def second_sentence(group) -> str:
    """Recommends a method for each renderer, with its cost; "" if there are too few rounds, which the verdict states."""
    if few_rounds(group.rows):
        return ""
    parts, allowed = [], kGood
    for renderer in group.renderers:
        rows = [r for r in group.rows if r["renderer"] == renderer]
        allowed = max(allowed, allowed_share(rows))
        pick, others = recommended(rows)
        if pick is None:
            known = [r for r in rows if r["status"] == "ok" and number(r, "error", "relRms") is not None]
            if known:
                least = min(known, key=lambda r: r["error"]["relRms"])
                parts.append(f"on {html.escape(renderer)} no method reaches that; {code(least['method'])} is the most accurate")
            else:
                parts.append(f"on {html.escape(renderer)} nothing was rendered")
            continue
        text = f"on {html.escape(renderer)} use {code(pick['method'])}, which {cost_words(pick)}"
        # cost_words names schlick already.
        names = [code(r["method"]) for r in others if r["method"] != "schlick"]
        if names:
            text += f", or from {listed(names, 'or')}" if "no significant difference" in text else (
                f" and shows no significant difference in time from {listed(names, 'or')}")
        parts.append(text)
    return f"For an error above 1 % in at most {percent(allowed)} of the pixels, {'; '.join(parts)}."
