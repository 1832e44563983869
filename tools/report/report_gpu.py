"""The static estimates of a GPU compiler: tables and plots per GPU family."""
from markupsafe import Markup

from report_data import number
from report_plots import cost_against_payload

kTraversal = ("traversal", "intersection")  # the driver's traversal shader, identical for every method


def traverses_apart(entry: dict) -> bool:
    """Returns whether traversal is a separate shader. Iterative methods inline it, so the two kinds must not be compared."""
    return any(word in str(s.get("stage", "")).lower() for s in entry.get("stages") or [] for word in kTraversal)


def own_cost(entry: dict):
    """Returns the inverse throughput of a pipeline's shaders without traversal, each counted once; None if unknown
    (iterative methods)."""
    if not traverses_apart(entry):
        return None
    own = [number(s, "inverseThroughput") for s in entry.get("stages") or []
           if not any(word in str(s.get("stage", "")).lower() for word in kTraversal)]
    return sum(v or 0 for v in own) if any(v is not None for v in own) else None


def gpu_sections(model: list, rows: list) -> list:
    payload = {row["method"]: row.get("payloadBytes") for row in rows}
    sections = []
    for family in dict.fromkeys(entry.get("family") for entry in model):
        entries = [entry for entry in model if entry.get("family") == family]
        scene = entries[0].get("scene")
        cost, stack = [], []
        for entry in (e for e in entries if e.get("scene") == scene):
            method, size = entry.get("method"), payload.get(entry.get("method"))
            if size is not None and own_cost(entry) is not None:
                cost.append((size, own_cost(entry), method))
            deepest = max((entry.get("stackBytes") or {"": None}).values(), key=lambda v: v or 0)
            if size is not None and deepest is not None:
                stack.append((size, deepest, method))
        plots = [cost_against_payload(cost, family, "inverse throughput, no traversal"),
                 cost_against_payload(stack, family, "largest stack of a stage in bytes")]
        sections.append({"family": family, "scene": scene, "entries": entries, "payload": payload,
                         "plots": [Markup(p) for p in plots if p]})
    return sections
