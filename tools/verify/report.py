#!/usr/bin/env python3
"""Open reports of runs (*.html of a folder) in a headless browser: every picture has pixels, every
section is there and has a height, links lead to sections, nothing is loaded from elsewhere, no
error of a script or of the page; a screenshot of each is not empty.

Without a browser the check says that it is skipped.
"""
import argparse
import html
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

BROWSERS = ("chromium-headless-shell", "chromium", "google-chrome", "chromium-browser")
# Runs in a copy of the page; what it finds becomes the text of the page.
PROBE = """
<script>
window.addEventListener("load", () => {
  const images = [...document.images];
  const sections = [...document.querySelectorAll("section")];
  const found = {
    images: images.map(i => [i.alt, i.complete ? i.naturalWidth : 0, i.naturalHeight, i.width]),
    sections: sections.map(s => [s.id, s.getBoundingClientRect().height]),
    links: [...document.querySelectorAll("a")].map(a => a.getAttribute("href")),
    loaded: performance.getEntriesByType("resource").map(r => r.name)
      .filter(n => !n.startsWith("data:")),
    rows: document.querySelectorAll("tr").length,
    wide: document.documentElement.scrollWidth - document.documentElement.clientWidth,
    title: document.title,
  };
  document.body.innerText = "FOUND" + JSON.stringify(found) + "END";
});
</script></body>"""
NEEDED = {"summary", "pictures", "conservation", "events", "times", "outputs", "histories", "plan",
          "deck"}


def browser():
    return next((path for path in map(shutil.which, BROWSERS) if path), None)


def call(program, words, page):
    with tempfile.TemporaryDirectory() as profile:
        return subprocess.run(
            [program, "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars",
             f"--user-data-dir={profile}", *words, page.resolve().as_uri()],
            capture_output=True, text=True, timeout=120, check=True).stdout


def opened(program, page):
    """What a browser sees of a page."""
    text = page.read_text(encoding="utf-8")
    with tempfile.TemporaryDirectory() as folder:
        copy = pathlib.Path(folder) / page.name
        copy.write_text(text.replace("</body>", PROBE), encoding="utf-8")
        dom = call(program, ["--dump-dom", "--virtual-time-budget=10000"], copy)
    match = re.search(r"FOUND(\{.*\})END", dom, re.DOTALL)
    if not match:
        raise SystemExit(f"RESULT: {page.name}: the browser shows no page")
    return json.loads(html.unescape(match.group(1)))


def faults_of(seen):
    faults = [f"the picture {alt!r} has no pixels" for alt, width, height, shown in seen["images"]
              if width < 100 or height < 100 or shown < 100]
    if not seen["images"]:
        faults.append("it has no picture")
    ids = {name for name, _ in seen["sections"]}
    faults += [f"section {name} is missing" for name in sorted(NEEDED - ids)]
    faults += [f"section {name} has no height" for name, height in seen["sections"] if height < 20]
    faults += [f"the link {link} leads nowhere" for link in seen["links"]
               if not link.startswith("#") or link[1:] not in ids]
    faults += [f"it loads {name}" for name in seen["loaded"]]
    if seen["wide"] > 0:
        faults.append(f"it is {seen['wide']} pixels wider than the window")
    return faults


def screenshot(program, page):
    """Shares of pixels that are neither white nor background."""
    import matplotlib.image

    picture = page.with_suffix(".png")
    call(program, [f"--screenshot={picture.resolve()}", "--window-size=1200,2400"], page)
    pixels = matplotlib.image.imread(picture)[..., :3]
    return float((pixels.min(axis=2) < 0.9).mean())


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--folder", required=True, type=pathlib.Path)
    given = parser.parse_args()
    program = browser()
    if program is None:
        print("skipped: no headless browser (Debian: chromium-headless-shell)")
        print("RESULT: skipped, no headless browser")
        return 0
    pages = sorted(given.folder.glob("*.html"))
    pictures = rows = 0
    for page in pages:
        seen = opened(program, page)
        faults = faults_of(seen)
        ink = screenshot(program, page)
        if ink < 0.02:
            faults.append(f"its screenshot is empty ({ink:.1%} of the pixels)")
        for fault in faults:
            print(f"RESULT: {page.name}: {fault}")
        if faults:
            return 1
        pictures += len(seen["images"])
        rows += seen["rows"]
        print(f"{page.name}: {len(seen['images'])} pictures, {len(seen['sections'])} sections, "
              f"{seen['rows']} rows")
    print(f"RESULT: {len(pages)} reports opened in {pathlib.Path(program).name}: {pictures} "
          f"pictures drawn, {rows} rows, nothing loaded from elsewhere")
    return 0 if pages else 1


if __name__ == "__main__":
    sys.exit(main())
