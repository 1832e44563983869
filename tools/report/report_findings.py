"""The paper's findings compared with the measurements of this run. Returns plain structures for the page."""
import html

from report_data import has_enough_rounds, kFewestRounds, number, timed
from report_gpu import own_cost, traverses_apart
from report_format import energy, interval, percent, plain, ratio, group_size
from report_words import bold, code, mostly, verdict

kWords = {"same": "no significant difference", "faster": "faster", "slower": "slower", "": "too few rounds"}


def group_title(group) -> str:
    return f"{group.scene}, {group_size(group)}"


def is_lavapipe(device: str) -> bool:
    return any(word in (device or "").lower() for word in ("llvmpipe", "lavapipe"))


def counted(words: list, subject: str) -> str:
    """"slower in 2, no significant difference in 4 of 6 cases"."""
    known = [w for w in words if w]
    if not known:
        return f"{subject}: no times, or fewer than {kFewestRounds} rounds, in this run."
    parts = [f"{kWords[w]} in {known.count(w)}" for w in ("faster", "slower", "same") if w in known]
    return f"{subject}: {', '.join(parts)} of {len(known)} cases."


def exact_against_schlick(groups) -> dict:
    rows, words = [], []
    for group in groups:
        for renderer in group.renderers:
            row = group.row(renderer, "fresnel")
            if row is None or not timed(row) or group.row(renderer, "schlick") is None:
                continue
            word = verdict(row)
            words.append(word)
            relative = row.get("ratioToSchlick") or {}
            error = [group.row(renderer, m) for m in ("schlick", "fresnel")]
            rows.append([group_title(group), renderer, ratio(number(relative, "median")),
                         interval(number(relative, "low"), number(relative, "high")), kWords[word],
                         *(plain(number(r, "error", "relRms")) for r in error)])
    return {"id": "exact", "question": "Is exact Fresnel faster than Schlick?",
            "paper": "Schlick was expected to be fastest; the exact mean of Rₛ and Rₚ was even faster.",
            "answer": [counted(words, f"{code('fresnel')} against {code('schlick')}")],
            "head": ["scene", "renderer", "fresnel / schlick", "quartiles", "verdict", "rel. RMS schlick",
                     "rel. RMS fresnel"], "rows": rows}


# (reduced method, full method)
kReductions = (("sp-cosine", "sp"), ("sp-ratio", "sp"), ("stokes-half", "stokes"), ("stokes-linear", "stokes"))


def payloads(groups, devices) -> dict:
    rows, words, shown = [], [], set()
    for group in groups:
        for renderer in group.renderers:
            for method, whole in kReductions:
                small, large = group.row(renderer, method), group.row(renderer, whole)
                if small is None or large is None or not timed(small) or not timed(large):
                    continue
                quotient = small["medianMs"] / large["medianMs"]
                quartiles = (small.get("quartilesMs"), large.get("quartilesMs"))
                overlap = all(quartiles) and quartiles[0][0] <= quartiles[1][1] and quartiles[1][0] <= quartiles[0][1]
                same = whole in (small.get("noSignificantDifference") or []) or overlap
                word = "same" if same else "faster" if quotient < 1 else "slower"
                if not has_enough_rounds(small) or not has_enough_rounds(large):
                    word = ""
                # On lavapipe payloads of 12 to 36 bytes make no significant difference, so other costs cause the difference.
                bytes_differ = not (is_lavapipe(devices.get(renderer)) and
                                    all(12 <= (r.get("payloadBytes") or 0) <= 36 for r in (small, large)))
                if bytes_differ:
                    words.append(word)
                shown.add(renderer)
                rows.append([group_title(group), renderer, f"{method} / {whole}",
                             f"{small.get('payloadBytes')} / {large.get('payloadBytes')}", ratio(quotient),
                             kWords[word] + ("" if bytes_differ or same else "; not due to payload size")])
    answer = [counted(words, "The method with the smaller payload")] if words else []
    for renderer, device in devices.items():
        if renderer not in shown:
            continue
        if is_lavapipe(device):
            answer.append(f"The device of {html.escape(renderer)} is a CPU ({html.escape(device)}), on which payloads of 12 to 36 bytes "
                          "show no significant difference: those rows are not counted. A difference there is due to the "
                          "method’s arithmetic and does not predict the cost of payload bytes on a GPU.")
        elif renderer == "embree":
            answer.append("On embree a payload is the return value of a function: a difference is due to the "
                          "arithmetic of packing.")
    return {"id": "payloads", "question": "Do the payload reductions help?",
            "paper": "They brought no large gain.", "answer": answer,
            "head": ["scene", "renderer", "methods", "bytes", "ratio of medians", "verdict"], "rows": rows}


def error_rows(groups, wrongs, methods) -> list:
    rows = []
    for group in groups:
        for method in methods:
            # The renderers share the optics: report the first one that has the image.
            for renderer in group.renderers:
                wrong, row = wrongs.get((group.key, renderer, method)), group.row(renderer, method)
                if wrong is None or row is None:
                    continue
                rows.append([group_title(group), renderer, method, plain(number(row, "error", "relRms")),
                             percent(number(row, "error", "shareOver1Percent")),
                             plain(number(row, "error", "perceptual")), energy(number(row, "error", "energyRatio")),
                             wrong.location or "none",
                             "–" if wrong.dolp_off is None or wrong.dolp_rest is None
                             else f"{percent(wrong.dolp_off)} / {percent(wrong.dolp_rest)}"])
                break
    return rows


kErrorHead = ["scene", "renderer", "method", "rel. RMS", "pixels with error > 1 %", "FLIP", "energy",
              "location", "DoLP there / elsewhere"]


def error_sentences(groups, wrongs, method) -> list:
    """Returns one sentence per scene, for its first group."""
    answer, seen = [], set()
    for group in groups:
        if group.scene in seen:
            continue
        for renderer in group.renderers:
            wrong, row = wrongs.get((group.key, renderer, method)), group.row(renderer, method)
            if wrong is None or row is None:
                continue
            seen.add(group.scene)
            sum_ratio = number(row, "error", "energyRatio")
            light = "" if sum_ratio is None or abs(sum_ratio - 1) < 5e-4 else (
                f"; the total energy is {percent(abs(sum_ratio - 1))} too {'high' if sum_ratio > 1 else 'low'}")
            answer.append(f"{bold(group.scene)}: {code(method)} has an error above 1 % in "
                          f"{percent(number(row, 'error', 'shareOver1Percent'))} of the pixels{mostly(wrong)}; relative RMS error "
                          f"{plain(number(row, 'error', 'relRms'))}{light}.")
            break
    return answer or [f"{code(method)} was not run."]


def added_by_ratio(groups, added) -> list:
    answer, seen = [], set()
    for group in groups:
        wrong = added.get(group.key)
        if group.scene in seen or wrong is None:
            continue
        seen.add(group.scene)
        answer.append(f"{bold(group.scene)}: {code('sp-ratio')}, the reduced payload of {code('sp')}, "
                      f"changes {percent(wrong.share)} of the pixels by more than 1 %{mostly(wrong)}.")
    return answer


def bottleneck(model, all_rows) -> dict:
    finding = {"id": "bottleneck", "question": "Where is the bottleneck?",
               "paper": "Left open, for other GPUs and scenes too.", "head": [], "rows": []}
    if not model:
        finding["answer"] = ["Not estimated in this run: <code>malus compare --gpu-model navi21,navi31</code> adds the "
                             "static estimates of a GPU compiler. The times above are valid only for the devices named."]
        return finding
    answer, rows = [], []
    for entry in model:
        stages = [s for s in entry.get("stages", []) if number(s, "inverseThroughput") is not None]
        if not stages or not traverses_apart(entry):
            continue
        worst = max(stages, key=lambda s: s["inverseThroughput"])
        total = sum(s["inverseThroughput"] for s in stages)
        rows.append([entry.get("family"), entry.get("scene") or "–", entry.get("method"), worst["stage"],
                     plain(worst["inverseThroughput"]), percent(worst["inverseThroughput"] / total if total else None)])
    for family in dict.fromkeys(r[0] for r in rows):
        stages = [r[3] for r in rows if r[0] == family]
        top = max(dict.fromkeys(stages), key=stages.count)
        answer.append(f"{bold(family)}: by the compiler’s estimate the costliest stage is {html.escape(top)} in "
                      f"{stages.count(top)} of {len(stages)} pipelines.")
        # Compare the shaders of the methods, without traversal, for the first scene.
        entries = [e for e in model if e.get("family") == family]
        cost = {e["method"]: own_cost(e) for e in entries if e.get("scene") == entries[0].get("scene")}
        cost = {method: value for method, value in cost.items() if value}
        if len(cost) > 1:
            payload = {r["method"]: r.get("payloadBytes") for r in all_rows}
            ends = [min(cost, key=cost.get), max(cost, key=cost.get)]
            named = [f"{plain(cost[m])} ({code(m)}, {payload.get(m, 'unknown')} bytes)" for m in ends]
            exact = "" if not {"schlick", "fresnel"} <= cost.keys() else (
                f"; {code('fresnel')} has {ratio(cost['fresnel'] / cost['schlick'])} times the estimate of "
                f"{code('schlick')}")
            answer.append(f"{bold(family)}: without traversal, the inverse throughput of a pipeline’s shaders ranges "
                          f"from {named[0]} to {named[1]}{exact}.")
    if any(not traverses_apart(entry) for entry in model):
        answer.append("Iterative methods inline traversal in one shader and are not compared with the others.")
    answer.append("These are static estimates of compiled code, each stage counted once. They are not times.")
    finding.update(answer=answer, rows=rows, head=["GPU family", "scene", "method", "costliest stage",
                                                   "inverse throughput", "share of all stages"])
    return finding


def needed(groups, wrongs) -> dict:
    answer, seen = [], set()
    for group in groups:
        for renderer in group.renderers:
            wrong = wrongs.get((group.key, renderer, "polarization"))
            if wrong is None or group.scene in seen:
                continue
            seen.add(group.scene)
            share = number(group.row(renderer, "fresnel"), "error", "shareOver1Percent")
            answer.append(f"{bold(group.scene)}: without polarization {percent(share)} of the pixels have "
                          f"an error above 1 %{mostly(wrong)}."
                          + ("" if wrong.dolp_off is None or wrong.dolp_rest is None else
                             f" Their median degree of polarization is {percent(wrong.dolp_off)}, that of the others "
                             f"{percent(wrong.dolp_rest)}."))
    return {"id": "needed", "question": "Which scenes need polarization at all?",
            "paper": "Left open. One mirror bounce of unpolarized light needs none; two bounces can extinguish it.",
            "answer": answer or [f"{code('fresnel')} was not run."], "head": kErrorHead,
            "rows": error_rows(groups, wrongs, ["schlick", "fresnel"])}


def findings(groups, wrongs, added, devices, model, all_rows) -> list:
    """wrongs: error summaries by (group key, renderer, method); added: by group key, sp-ratio relative to sp."""
    return [
        exact_against_schlick(groups),
        payloads(groups, devices),
        {"id": "cosine", "question": "How wrong is |cos|?",
         "paper": "The s and p powers are rotated by |cos|. Malus’s law has cos²: at 45° |cos| returns 1.41 times the "
                  "light.", "answer": error_sentences(groups, wrongs, "sp"), "head": kErrorHead,
         "rows": error_rows(groups, wrongs, ["sp", "sp-cosine", "sp-malus"])},
        {"id": "ratio", "question": "How wrong is the ratio form, and in which pixels?",
         "paper": "It makes large colour errors in some situations.",
         "answer": error_sentences(groups, wrongs, "sp-ratio") + added_by_ratio(groups, added), "head": kErrorHead,
         "rows": error_rows(groups, wrongs, ["sp-ratio"])},
        {"id": "components", "question": "What is lost with s and p alone, and with linear light alone?",
         "paper": "Left open: s and p drop the ±45° component from the third surface on, and circular light.",
         "answer": error_sentences(groups, wrongs, "sp-malus") + error_sentences(groups, wrongs, "stokes-linear"),
         "head": kErrorHead, "rows": error_rows(groups, wrongs, ["sp-malus", "stokes-linear", "stokes",
                                                                 "stokes-half"])},
        needed(groups, wrongs),
        bottleneck(model, all_rows),
    ]
