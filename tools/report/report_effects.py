"""The table of effects: all of them, what the picture calls for, importance."""
from report_data import number
from report_format import interval


def ratio_interval(row: dict, column: str) -> str:
    """The quartiles of a column's time over that of all effects."""
    return interval(number(row, column, "ratioToAll", "low"), number(row, column, "ratioToAll", "high"))


def reasons_of(effects: list) -> list:
    """Why auto takes another method than stokes, once a scene."""
    reasons = {}
    for row in effects:
        automatic = row.get("auto") or {}
        if automatic.get("why"):
            reasons[row["scene"]] = f"{row['scene']}: {automatic['method']} in place of stokes, {automatic['why']}."
    return list(reasons.values())
