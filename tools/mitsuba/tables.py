"""The results of tools/mitsuba/compare as Markdown, and the values outside the tolerances."""

RENDERERS = ("reference", "embree")


def markdown(results: dict) -> str:
    lines = ["| scene | malus | RMS S0 | S1 | S2 | S3 | outliers | not explained |", "|---|---|---|---|---|---|---|---|"]
    for name, scene in deterministic(results):
        for renderer in RENDERERS:
            r = scene[renderer]
            cells = [f"{value:.1e}" for value in r["rmsOrdinary"]]
            lines.append(f"| {name} | {renderer} | {' | '.join(cells)} | {r['outliers']} ({r['outlierShare']:.2%}) | "
                         f"{r['unexplained']} |")
    lines += ["", "RMS of the difference relative to the mean S0, without the outliers (a component differs by more than",
              "1e-3 (S0 + mean S0)). Explained: the pixel changes as much if its centre moves by 1/1000 pixel.", "",
              "| scene | integrator of Mitsuba | values | outside the bound | RMS z | largest z |",
              "|---|---|---|---|---|---|"]
    for name, scene in deterministic(results):
        for part in ("smooth", "diffuse"):
            if part in scene["stock"]:
                s = scene["stock"][part]
                z = [f"{s[k]:.2f}" if s[k] is not None else "-" for k in ("rmsZ", "maxZ")]
                lines.append(f"| {name} | path, {part} | {s['values']} | {s['violations']} | {z[0]} | {z[1]} |")
        if "stokesMax" in scene["stock"]:
            lines.append(f"| {name} | stokes | largest difference {scene['stock']['stokesMax']:.1e} | | | |")
    return "\n".join(lines + sampled(results) + [""])


def deterministic(results: dict) -> list:
    """Returns the names and results of the scenes that are compared pixel by pixel without noise."""
    return [(name, scene) for name, scene in results.items() if "lamps" not in scene]


def sampled(results: dict) -> list[str]:
    """Returns the lines about scenes that lamps light."""
    lines = []
    for name, scene in results.items():
        for renderer, r in scene.get("lamps", {}).items():
            cells = [" ".join(f"{value:.{digits}}" for value in r[key]) for key, digits in
                     (("noise", "0e"), ("meanDifference", "1e"), ("bias", "1f"))]
            numbers = f"{r['values']} | {r['violations']} | {r['rmsZ']:.2f} | {r['maxZ']:.2f}"
            lines.append(f"| {name} | {renderer} | {numbers} | {' | '.join(cells)} |")
    head = ["", "| scene with lamps | malus | values | outside the bound | RMS z | largest z | noise of a value, S0 to S3 "
            "| difference of the means | the same in standard errors |", "|---|---|---|---|---|---|---|---|---|"]
    return head + lines if lines else []


def failures(results: dict, tolerances: dict) -> list[str]:
    """Returns a sentence for each number over its tolerance: that of the scene, or the default."""
    sentences = []

    def check(what: str, value: float, most: float):
        if not value <= most:
            sentences.append(f"{what} is {value:.3g}, expected at most {most:.3g}")

    for name, scene in results.items():
        most = tolerances["default"] | tolerances["scenes"].get(name, {})
        for renderer, r in scene.get("lamps", {}).items():
            check(f"{name}, {renderer}: number of values outside the bound", r["violations"], 0)
            check(f"{name}, {renderer}: RMS of z", r["rmsZ"], most["rmsZ"])
            check(f"{name}, {renderer}: difference of the means in standard errors", max(r["bias"]), most["bias"])
        if "lamps" in scene:
            continue
        for renderer in RENDERERS:
            r = scene[renderer]
            for k in range(4):
                check(f"{name}, {renderer}: RMS of S{k}", r["rmsOrdinary"][k], most["rms"])
            check(f"{name}, {renderer}: share of outliers", r["outlierShare"], most["outlierShare"])
            check(f"{name}, {renderer}: share of outliers not explained",
                  r["unexplained"] / (scene["width"] * scene["height"]), most["unexplainedShare"])
        for part in ("smooth", "diffuse"):
            if part in scene["stock"]:
                stock = scene["stock"][part]
                check(f"{name}, path, {part}: share of values outside the bound",
                      stock["violations"] / stock["values"], most["pathShare"])
        check(f"{name}: difference from Mitsuba's stokes integrator", scene["stock"].get("stokesMax", 0), most["stokes"])
    return sentences
