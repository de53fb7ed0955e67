"""The reliability of several runs' claims as one picture."""

SIDE = 240
MARGIN = 56
GAP = 40
BINS = 10


def pooled(reliabilities):
    """Bins of several runs as one: (claims, mean probability, share that is there) each."""
    bins = []
    for tenth in range(BINS):
        parts = [r[tenth] for r in reliabilities if r[tenth]["count"]]
        claims = sum(part["count"] for part in parts)
        if claims:
            mean = [sum(part["count"] * part[key] for part in parts) / claims
                    for key in ("mean_probability", "observed")]
            bins.append((claims, *mean))
    return bins


def expected_error(bins):
    """ECE: how far claims are off, in the mean over claims."""
    total = sum(claims for claims, _, _ in bins)
    return sum(claims * abs(said - there) for claims, said, there in bins) / max(total, 1)


def text(x, y, words, anchor="middle", size=12, more=""):
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" font-size="{size}"{more}>{words}</text>'


def panel(left, title, bins):
    top = MARGIN
    most = max((claims for claims, _, _ in bins), default=1)
    lines = [text(left + SIDE / 2, top - 28, title, size=14),
             text(left + SIDE / 2, top - 10,
                  f"{sum(b[0] for b in bins)} claims, ECE {expected_error(bins):.3f}"),
             f'<rect x="{left}" y="{top}" width="{SIDE}" height="{SIDE}" fill="none" stroke="#888"/>',
             f'<path d="M{left} {top + SIDE}L{left + SIDE} {top}" stroke="#bbb" stroke-dasharray="4 4"/>']
    for tenth in range(0, BINS + 1, 2):
        at = SIDE * tenth / BINS
        lines.append(text(left + at, top + SIDE + 16, f"{tenth / BINS:.1f}"))
        lines.append(text(left - 6, top + SIDE - at + 4, f"{tenth / BINS:.1f}", "end"))
    points = [(left + SIDE * said, top + SIDE * (1 - there), claims) for claims, said, there in bins]
    if points:
        way = "L".join(f"{x:.1f} {y:.1f}" for x, y, _ in points)
        lines.append(f'<path d="M{way}" fill="none" stroke="#2266aa" stroke-width="1.5"/>')
    for x, y, claims in points:
        radius = 2 + 7 * (claims / most) ** 0.5
        lines.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{radius:.1f}" fill="#2266aa" fill-opacity="0.7"/>')
    lines.append(text(left + SIDE / 2, top + SIDE + 36, "believed probability"))
    return lines


def reliability_svg(bins_of):
    """One panel for each named list of bins."""
    width = MARGIN + len(bins_of) * (SIDE + GAP)
    height = 2 * MARGIN + SIDE
    middle = MARGIN + SIDE / 2
    lines = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
             'font-family="sans-serif">', f'<rect width="{width}" height="{height}" fill="white"/>',
             text(14, middle, "part that is there", more=f' transform="rotate(-90 14 {middle:.1f})"')]
    for number, (title, bins) in enumerate(bins_of.items()):
        lines += panel(MARGIN + number * (SIDE + GAP), title, bins)
    return "\n".join(lines + ["</svg>"]) + "\n"
