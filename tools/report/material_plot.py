#!/usr/bin/env python3
"""Plots the curves of `malus material --plot`: reads the command's JSON from standard input; the argument is the image file."""
import json
import sys

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402


def main() -> None:
    rows = json.load(sys.stdin)
    if len(rows) < 2:
        sys.exit("material_plot: a curve needs two angles or wavelengths or more; use --angle or --wavelength "
                 "FROM:TO:STEP")
    first, last = rows[0], rows[-1]
    spectrum = first["wavelengthNm"] != last["wavelengthNm"]
    if spectrum and first["angleDegrees"] != last["angleDegrees"]:
        sys.exit("material_plot: a plot has one horizontal axis; use a range for --angle or for --wavelength")
    x = [r["wavelengthNm" if spectrum else "angleDegrees"] for r in rows]
    pyplot.rcParams.update({"svg.hashsalt": "malus", "svg.fonttype": "none"})
    figure, (powers, phases) = pyplot.subplots(2, 1, sharex=True, figsize=(6.4, 6.4), height_ratios=(2, 1))
    curves = [("rs", "$R_s$", "#c2541a", "-"), ("rp", "$R_p$", "#3f7fb5", "-"), ("ts", "$T_s$", "#c2541a", ":"),
              ("tp", "$T_p$", "#3f7fb5", ":"), ("diattenuation", "$D$", "#555555", "--")]
    for name, label, colour, style in curves:
        if rows[0][name] is not None:
            powers.plot(x, [r[name] for r in rows], style, color=colour, label=label)
    powers.set_ylabel("fraction of the power")
    powers.legend(frameon=False, ncol=2)
    phases.plot(x, [r["phaseDegrees"] for r in rows], color="#555555")
    phases.set_ylabel("arg($r_p r_s^*$), degrees")
    phases.set_ylim(-190, 190)
    phases.set_yticks([-180, -90, 0, 90, 180])
    phases.set_xlabel("wavelength in vacuum, nm" if spectrum else "angle of incidence, degrees")
    phases.set_xlim(min(x), max(x))
    for axes in (powers, phases):
        axes.grid(alpha=0.3)
    name = first["material"] or "user-defined constants"
    if spectrum:
        title = f"{name} at {first['angleDegrees']:g} degrees from medium {first['outside']:g}"
    else:
        at = f" at {first['wavelengthNm']:g} nm" if first["wavelengthNm"] else ""
        title = f"{name}{at}: {first['eta']:g} - i {first['k']:g} from medium {first['outside']:g}"
    powers.set_title(title)
    figure.align_ylabels()
    figure.tight_layout()
    path = sys.argv[1]
    metadata = {"Date": None} if path.endswith("svg") else {"CreationDate": None} if path.endswith("pdf") else {}
    figure.savefig(path, dpi=120, metadata=metadata)


if __name__ == "__main__":
    main()
