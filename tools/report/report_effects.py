"""The effects table: every effect, the effects that the image needs, and importance."""
from report_data import number
from report_format import interval


def ratio_interval(row: dict, column: str) -> str:
    """Returns the quartiles of a column's time relative to the time with every effect."""
    return interval(number(row, column, "ratioToAll", "low"), number(row, column, "ratioToAll", "high"))


def replacement_reasons(effects: list) -> list:
    """Returns, once per scene, the reason why auto replaces the method stokes."""
    reasons = {}
    for row in effects:
        automatic = row.get("auto") or {}
        if automatic.get("why"):
            reasons[row["scene"]] = f"{row['scene']}: {automatic['method']} replaces stokes, {automatic['why']}."
    return list(reasons.values())
