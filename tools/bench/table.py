"""The printed table of a bench: this build, the other one, the change, the limit."""

LARGE_CHANGE = 0.05


def verdict(case, value):
    """'' without a limit, 'ok', or 'OVER'/'UNDER' when it does not hold."""
    limit = getattr(case, "limit", None)
    if limit is None:
        return ""
    if getattr(case, "at_least", False):
        return "ok" if value >= limit else "UNDER"
    return "ok" if value <= limit else "OVER"


def rows(cases, mine, other, calibration):
    """Lists of cells, one a figure; cases first, then kernels."""
    by_name = {case.name: case for case in cases}
    names = [case.name for case in cases if case.name in mine]
    names += [name for name in mine if name not in by_name]
    for name in names:
        case, value = by_name.get(name), mine[name]
        before = other["figures"].get(name)
        change = (value / before - 1) if before else None
        limit = getattr(case, "limit", None)
        is_time = getattr(case, "unit", "ns").startswith("ns")
        yield [name, f"{value:.2f}", f"{value / calibration:.0f}" if is_time else "",
               f"{before:.2f}" if before else "-",
               f"{100 * change:+.1f} %" if change is not None else "-",
               ("*" if change is not None and abs(change) > LARGE_CHANGE else ""),
               f"{limit:g}" if limit is not None else "-", verdict(case, value)]


def print_table(cases, mine, other, calibration):
    """Prints the table; returns the names of figures outside their limit."""
    head = ["case", "figure", "in loops", "other", "change", "", "limit", ""]
    body = list(rows(cases, mine, other, calibration))
    widths = [max(len(row[i]) for row in [head] + body) for i in range(len(head))]
    print(f"against: {other.get('commit', 'nothing recorded')} {other.get('date', '')} "
          f"{other.get('machine', '')}")
    for row in [head] + body:
        cells = [row[0].ljust(widths[0])] + [c.rjust(w) for c, w in zip(row[1:], widths[1:])]
        print("  ".join(cells).rstrip())
    return [row[0] for row in body if row[-1] in ("OVER", "UNDER")]
