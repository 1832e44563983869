"""Choices of `malus render --max-error`: points of the plot of error against time, and their table."""
from report_data import number
from report_format import interval, listed


def is_choice(row: dict) -> bool:
    return "maxErrors" in row


def _errors(row: dict) -> str:
    return listed([f"{100 * error:g} %" for error in row["maxErrors"]])


def point_name(row: dict) -> str:
    """The label of a point: a method, or the errors within which it was chosen. The margin of the plot has room for
    about 17 letters."""
    return f"≤ {listed([f'{100 * error:g}' for error in row['maxErrors']])} %" if is_choice(row) else row["method"]


def choice_table(group) -> list:
    """One entry per choice of a group: what it leaves out, its error and its time relative to schlick."""
    return [{"renderer": row["renderer"], "within": _errors(row), "failed": row["status"] != "ok" and row["status"],
             "parts": ", ".join(row["parts"]) or "nothing is left out", "error": number(row, "displayRelRms"),
             "wrong": number(row, "error", "shareOver1Percent"), "ms": number(row, "medianMs"),
             "ratio": number(row, "ratioToSchlick", "median"),
             "interval": interval(number(row, "ratioToSchlick", "low"), number(row, "ratioToSchlick", "high"))}
            for row in group.choices]
