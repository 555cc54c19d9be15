"""docs/accuracy.md from the studies of regression/accuracy and their CSV files in docs/accuracy."""
import csv
import json
import math
import subprocess
import sys

COMPONENTS = {"fluid": "Fluid, explicit steps", "pressure": "Fluid, pressure solve",
              "levels": "Refined levels", "solids": "Solids, explicit steps",
              "implicit": "Solids, implicit steps", "coupled": "Fluid and solids",
              "reactions": "Reactions"}
TARGETS = (0.01, 0.001, 0.0001)  # of the relative error
EXACT = 1e-9  # a relative error that is round-off
SLOW = 2  # a default that takes so many times the best needs a sentence

HEAD = """# What accuracy costs in time

This page is written by `./dev verify ladders_fluid ladders_pressure ladders_solids`. It contains
every study of `regression/accuracy`; each point is the median of up to {repeats} runs on one core,
and `sluice accuracy NAME` repeats a study. The times were measured on a machine of two cores with
occasional other load, so that they can be compared only within a study.

Errors are those of cell means: what a run has for a cell is compared with the mean of the exact
solution over that cell, integrated until the norm is known to 0.1 %
([how](user_guide.md#errors-of-cell-means)). Where there is no exact solution, a finer run takes its
place, averaged over each cell; its own error is below the dashed level of the picture (the
difference from a run with half its cells).

## Time to an error

Order is that of the default setting, between its two finest grids; *diverges* says that the error
grows there, *exact* that it is round-off. Times are those of the default and of the best setting to
a relative L1 error of 1, 0.1 and 0.01 %, interpolated between grids (≤: the coarsest grid has it
already; –: no run of the study reaches it). The last column names the best setting at the smallest
error that is reached.
"""


def read_study(path):
    """The study as a dictionary; lines of comment are dropped."""
    lines = path.read_text().splitlines()
    return json.loads("\n".join(line for line in lines if not line.strip().startswith("//")))


def read_rows(path):
    with path.open(newline="") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def duration(seconds):
    """A time for people, three digits."""
    for unit, factor in (("us", 1e-6), ("ms", 1e-3)):
        if seconds < 1000 * factor:
            return f"{seconds / factor:.3g} {unit}"
    return f"{seconds:.3g} s"


def cost(runs, target):
    """Seconds to the relative error by a power law between grids, and whether the coarsest grid has
    it already; None where no run has it. As `sluice accuracy` does."""
    coarser = None
    for row in runs:
        if row["status"] != "done" or not float(row["seconds"]) > 0:
            continue
        error, seconds = float(row["relative_l1"]), float(row["seconds"])
        if error <= target:
            if coarser is None:
                return seconds, True
            share = math.log(coarser[0] / target) / math.log(coarser[0] / max(error, 1e-300))
            return coarser[1] * (seconds / coarser[1]) ** share, False
        coarser = error, seconds
    return None


def settings_of(rows):
    """{setting: its rows, coarse to fine}, and the name of the default."""
    lines, default = {}, ""
    for row in rows:
        lines.setdefault(row["setting"], []).append(row)
        if row["default"] == "1":
            default = row["setting"]
    return lines, default


def order_of(runs):
    """Text: the order between the two finest runs of one setting."""
    done = [r for r in runs if r["status"] == "done"]
    if not done:
        return "fails"
    if len(done) < len(runs):
        return "fails at some"
    if len(done) < 2:
        return ""
    a, b = float(done[-2]["error"]), float(done[-1]["error"])
    if max(float(done[-2]["relative_l1"]), float(done[-1]["relative_l1"])) < EXACT:
        return "exact"
    if b > 1.1 * a:
        return "diverges"
    return f"{math.log(a / b) / math.log(int(done[-1]['cells']) / int(done[-2]['cells'])):.2f}"


class Summary:
    """What the table says of one study."""

    def __init__(self, name, study, rows):
        self.name, self.study = name, study
        lines, default = settings_of(rows)
        self.order = order_of(lines.get(default, []))
        self.cells, self.best = [], ""
        self.worst_ratio, self.faster = 0.0, ""  # of the default over the best, and which that is
        for target in TARGETS:
            found = {s: cost(runs, target) for s, runs in lines.items()}
            reached = {s: c for s, c in found.items() if c}
            if not reached:
                self.cells.append("–")
                continue
            best = min(reached, key=lambda s: reached[s][0])
            of_default = reached.get(default)
            self.best = best
            self.cells.append(f"{self.text(of_default)} · {self.text(reached[best])}")
            if of_default and of_default[1]:
                continue  # the coarsest grid of the default is good enough
            ratio = of_default[0] / reached[best][0] if of_default else math.inf
            if ratio > self.worst_ratio:
                self.worst_ratio, self.faster = ratio, best
        if self.best == default:
            self.best = "default" if len(lines) > 1 else "only one"

    @staticmethod
    def text(found):
        if found is None:
            return "not reached"
        return ("≤ " if found[1] else "") + duration(found[0])

    def line(self):
        title = f"[{self.study['title']}](#{anchor(self.study['title'])})"
        return (f"| {title} | {self.study['component']} | {self.order} | {' | '.join(self.cells)} "
                f"| {self.best} |\n")


def anchor(title):
    """The anchor that Markdown makes of a heading."""
    kept = "".join(c for c in title.lower() if c.isalnum() or c in " -_")
    return kept.replace(" ", "-")


def section(name, study, rows):
    """Heading, table of the default setting, and picture of one study, lines of Markdown."""
    what = study["variable"]
    if "reduce" in study:
        what += f", {study['reduce']}"
    lines = [f"\n### {study['title']}\n\n",
             f"`sluice accuracy {name}`: {study.get('norm', 'l1')} error of `{what}`.\n\n",
             "| cells | steps | error | relative | order | time |\n",
             "| --- | --- | --- | --- | --- | --- |\n"]
    for row in rows:
        if row["default"] != "1":
            continue
        cells = " x ".join(n for n in (row["nx"], row["ny"], row["nz"]) if n != "1")
        if row["status"] != "done":
            lines.append(f"| {cells} | {row['steps']} | {row['status']} | | | |\n")
            continue
        order = f"{float(row['order']):.2f}" if row["order"] else ""
        lines.append(f"| {cells} | {row['steps']} | {float(row['error']):.3e} | "
                     f"{100 * float(row['relative_l1']):.2g} % | {order} | "
                     f"{duration(float(row['seconds']))} |\n")
    lines.append(f"\n![error against time](accuracy/{name}.png) [CSV](accuracy/{name}.csv)\n")
    return lines


def studies_of(root):
    """{name: study} of all studies; each must say its component."""
    out = {}
    for path in sorted((root / "regression/accuracy").glob("*.study")):
        study = read_study(path)
        if study.get("component") not in COMPONENTS:
            raise SystemExit(f"{path}: \"component\" must be one of {', '.join(COMPONENTS)}")
        out[path.stem] = study
    return out


def slow_defaults(summaries):
    """Why each default that takes over SLOW times the best does."""
    lines = ["\n## Where the default takes over twice the time of the best\n\n"]
    for s in summaries:
        if s.worst_ratio <= SLOW:
            continue
        times = "does not reach what others do" if math.isinf(s.worst_ratio) else \
            f"takes up to {s.worst_ratio:.2g} times as long"
        reason = s.study.get("default_is_slower_because", "The reason is not known.")
        lines.append(f"- **{s.study['title']}**: the default {times} ({s.faster}). {reason}\n")
    return lines


BARS = """
## Error bars of decks

`sluice accuracy DECK` gives error bars without an exact solution, and `sluice run --target-error`
chooses a resolution by them ([how](user_guide.md)). `./dev verify bars` holds both against the true
errors of these studies, each at the resolution of its deck: {covered} of {all} bars cover the true
error, {sharp} are at most five times the error; of {asked} runs that were asked for the true error
of the deck's own resolution, {kept} have it or less. [All numbers](accuracy/bars.csv).

| study | quantity | bar over true error | error of the chosen run over the target |
| --- | --- | --- | --- |
"""


def bars_section(table, studies):
    """Lines of Markdown: how bars and targets compare with true errors."""
    rows = read_rows(table)
    ratios = [float(row["ratio"]) for row in rows]
    reached = {row["study"]: float(row["reached"]) / float(row["target"])
               for row in rows if row["reached"]}
    lines = [BARS.format(covered=sum(r >= 1 for r in ratios), all=len(rows),
                         sharp=sum(r <= 5 for r in ratios), asked=len(reached),
                         kept=sum(r <= 1 for r in reached.values()))]
    for row, ratio in zip(rows, ratios):
        title = studies[row["study"]]["title"]
        chosen = f"{reached[row['study']]:.2g}" if row["study"] in reached else "refused"
        lines.append(f"| [{title}](#{anchor(title)}) | `{row['quantity']}` | {ratio:.2g} "
                     f"| {chosen} |\n")
    return lines


def write_page(root, repeats):
    summaries, sections = [], {c: [] for c in COMPONENTS}
    for name, study in studies_of(root).items():
        table = root / "docs/accuracy" / f"{name}.csv"
        if not table.exists():
            continue
        rows = read_rows(table)
        summaries.append(Summary(name, study, rows))
        sections[study["component"]] += section(name, study, rows)
    summaries.sort(key=lambda s: list(COMPONENTS).index(s.study["component"]))
    lines = [HEAD.format(repeats=repeats),
             "\n| case | component | order | 1 %: default · best | 0.1 % | 0.01 % | best setting "
             "|\n",
             "| --- | --- | --- | --- | --- | --- | --- |\n"]
    lines += [s.line() for s in summaries]
    lines += slow_defaults(summaries)
    bars = root / "docs/accuracy/bars.csv"
    if bars.exists():
        lines += bars_section(bars, studies_of(root))
    for component, title in COMPONENTS.items():
        if sections[component]:
            lines += [f"\n## {title}\n"] + sections[component]
    (root / "docs/accuracy.md").write_text("".join(lines))


def draw_pictures(root, names=None):
    """The pictures again from the CSV files."""
    for name, study in studies_of(root).items():
        table = root / "docs/accuracy" / f"{name}.csv"
        if table.exists() and (names is None or name in names):
            subprocess.run([sys.executable, "-m", "sluice_tools", "workprecision",
                            str(table.resolve()), "-o", str(table.resolve().with_suffix(".png")),
                            "--title", study["title"], "--error-label",
                            f"{study.get('norm', 'l1')} error of {study['variable']}"],
                           cwd=root / "tools", check=True, stdout=subprocess.DEVNULL)
