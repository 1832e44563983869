#!/usr/bin/python3
"""The pages of `malus compare` in headless Chromium, at four widths, light and dark: no script error, nothing wider than
the window, no text cut off, readable contrast.

    report_layout_test.py [PAGE...]     PAGE: pages to check besides those that the test writes

Exit codes: 0 passed, 1 failed, 77 not run because there is no Chromium (tools/install-deps --browser).
"""
import html
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
import report_ablation_test  # noqa: E402
import report_test  # noqa: E402

kWidths = (390, 768, 1280, 1920)
kSchemes = {"light": 1, "dark": 0}  # values of Blink's setting preferredColorScheme
kErrors = "<script>window.kErrors = []; addEventListener('error', (e) => kErrors.push(String(e.message)), true);" \
          "addEventListener('unhandledrejection', (e) => kErrors.push(String(e.reason)));</script>"
# Tests every element that is shown. An element may be wider than the window only inside of a box that scrolls.
kProbe = """<script>
addEventListener("load", () => setTimeout(() => {
  const found = { errors: kErrors, width: innerWidth, page: document.documentElement.scrollWidth, wide: [], cut: [], pale: [],
                  images: 0, unsized: 0 };
  const scrolls = (e) => { for (; e; e = e.parentElement) if (getComputedStyle(e).overflowX === "auto") return true; return false; };
  const luminance = (text) => {
    const [r, g, b] = text.match(/[\\d.]+/g).map(Number).map((v) => (v /= 255) <= .04045 ? v / 12.92 : ((v + .055) / 1.055) ** 2.4);
    return .2126 * r + .7152 * g + .0722 * b;
  };
  found.back = luminance(getComputedStyle(document.body).backgroundColor);
  const back = luminance(getComputedStyle(document.body).backgroundColor);
  for (const e of document.body.querySelectorAll("*")) {
    const box = e.getBoundingClientRect(), style = getComputedStyle(e);
    if (!box.width || style.visibility === "hidden" || e.closest("script, .hidden, option, svg g, svg defs")) continue;
    const name = `${e.tagName} ${e.className.baseVal ?? e.className} ${e.textContent.trim().slice(0, 40)}`;
    if ((box.right > innerWidth + 1 || box.left < -1) && !scrolls(e)) found.wide.push(name);
    if (e.scrollWidth > e.clientWidth + 2 && style.overflowX === "hidden") found.cut.push(name);
    const own = [...e.childNodes].some((n) => n.nodeType === 3 && n.data.trim());
    if (own && !e.closest("svg, select, button")) {
      const fore = luminance(style.color), ratio = (Math.max(fore, back) + .05) / (Math.min(fore, back) + .05);
      if (ratio < 4.5) found.pale.push(`${name} ${ratio.toFixed(1)}`);
    }
    if (e.tagName === "IMG") { ++found.images; if (!e.getAttribute("width") || !e.getAttribute("height")) ++found.unsized; }
  }
  const result = document.createElement("pre");
  result.id = "probe-result";
  result.textContent = JSON.stringify(found);
  parent.document.body.append(result);
}, 500));
</script>"""


def probe(browser: str, page: pathlib.Path, width: int, scheme: str, folder: pathlib.Path) -> dict:
    text = page.read_text(encoding="utf-8")
    probed = text.replace("<head>", "<head>" + kErrors, 1).replace("</body>", kProbe + "</body>", 1)
    # In a frame, because the narrowest window of Chromium has 500 pixels.
    frame = folder / "frame.html"
    frame.write_text('<!DOCTYPE html><meta charset="utf-8"><meta name="color-scheme" content="light dark"><body>'
                     f'<iframe style="width: {width}px; height: 1200px; border: 0" srcdoc="{html.escape(probed)}"></iframe>',
                     encoding="utf-8")
    done = subprocess.run(
        [browser, "--headless", "--no-sandbox", "--disable-gpu", f"--user-data-dir={folder / 'profile'}",
         f"--blink-settings=preferredColorScheme={kSchemes[scheme]}", f"--window-size=2000,1300",
         "--virtual-time-budget=8000", "--dump-dom", frame.as_uri()], capture_output=True, text=True, timeout=300, check=False)
    start = done.stdout.find('<pre id="probe-result">')
    if start < 0:
        raise RuntimeError(f"{browser} gave no result: {done.stderr[-500:]}")
    end = done.stdout.index("</pre>", start)
    return json.loads(html.unescape(done.stdout[start + len('<pre id="probe-result">'):end]))


def write_pages(folder: pathlib.Path) -> list:
    """Pages with long names, failures and two sizes, of many rounds and of one, and a page of an ablation."""
    case = report_test.Report("test_effects")
    case.setUp()
    results = case.results
    results["rows"].append(report_test.row("embree", "schlick", depth=1, image=None))
    results["devices"]["embree"] = "Embree 3.13.5 on a processor with a long name, 128 threads, 16-wide vectors"
    results["machine"] = {"cpu": "A processor with a long name @ 2.00GHz", "threads": 128}
    results["date"] = "2026-01-31 12:00 UTC"
    results["scenes"]["tiny"]["title"] = "Averylongwordwithoutanyspaceinit" * 5
    pages = []
    for name, rounds in (("many.html", 7), ("few.html", 1)):
        for entry in results["rows"]:
            entry["samplesMs"] = [10.0] * rounds
        case.page(results)
        pages.append(pathlib.Path(shutil.copy(case.folder / "index.html", folder / name)))
    case.doCleanups()
    (folder / "ablation").mkdir()
    report_ablation_test.write_page(folder / "ablation")
    return [*pages, folder / "ablation" / "index.html"]


def main() -> int:
    browser = shutil.which("chromium") or shutil.which("chromium-browser")
    if browser is None:
        print("not run: there is no Chromium; tools/install-deps --browser installs it")
        return 77
    failures = 0
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        for page in [*write_pages(folder), *map(pathlib.Path, sys.argv[1:])]:
            for width in kWidths:
                for scheme in kSchemes:
                    found = probe(browser, page, width, scheme, folder)
                    bad = {k: found[k] for k in ("errors", "wide", "cut", "pale") if found[k]}
                    if found["page"] > found["width"]:
                        bad["overflow"] = [f"{found['page']} pixels in a window of {found['width']}"]
                    if found["unsized"] or not found["images"]:
                        bad["images"] = [f"{found['unsized']} of {found['images']} images have no size"]
                    if (found["back"] < 0.2) != (scheme == "dark"):
                        bad["scheme"] = [f"luminance {found['back']:.2f} of the background"]
                    if found["width"] != width:
                        bad["window"] = [f"{found['width']} pixels"]
                    for kind, names in bad.items():
                        failures += 1
                        print(f"{page.name}, {width} pixels, {scheme}: {kind}: {'; '.join(names[:5])}")
    print("passed" if failures == 0 else f"{failures} findings")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
