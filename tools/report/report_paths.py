"""The methods by both paths of a renderer, and the recursive methods that ran without recursion."""
from report_data import number
from report_format import interval, listed, ratio


def ratio_with_interval(row: dict, *names: str) -> str:
    """Returns the median and the quartiles of a ratio of times; "–" if it is unknown."""
    quartiles = interval(number(row, *names, "low"), number(row, *names, "high"))
    return ratio(number(row, *names, "median")) + (f" ({quartiles})" if quartiles else "")


def without_recursion(group) -> list:
    """Returns, for each reason, a sentence that names the methods of a group that a stack replaced the recursion of."""
    reasons = {}
    for row in group.rows:
        if row.get("withoutRecursion"):
            reasons.setdefault((row["renderer"], row["withoutRecursion"]), []).append(row["method"])
    return [f"On {renderer} a stack replaces the recursion of {listed(methods)}: {reason}."
            for (renderer, reason), methods in reasons.items()]
