"""The picture of dbef_gain.py: two panels of gain against eta, formula as curves, trace as points with error bars."""

INKS = ["#1f5fb4", "#c8590c", "#1b8a5f", "#8a4bb0"]
TEXT, MUTED, GRID = "#1a1c20", "#5c6470", "#dfe2e6"
WIDTH, HEIGHT, PANEL = 1000, 510, 400
LEFT, TOP, BOTTOM = 60, 110, 450
GAIN_MIN, GAIN_MAX = 0.95, 2.2


def text(x, y, words, size=14, ink=TEXT, anchor="start", weight="normal"):
    return '<text x="%.1f" y="%.1f" font-size="%d" fill="%s" text-anchor="%s" font-weight="%s">%s</text>' % (
        x, y, size, ink, anchor, weight, words)


def line(x1, y1, x2, y2, ink, width=1.0, dash=""):
    dashes = ' stroke-dasharray="%s"' % dash if dash else ""
    return '<line x1="%.1f" y1="%.1f" x2="%.1f" y2="%.1f" stroke="%s" stroke-width="%.1f"%s/>' % (
        x1, y1, x2, y2, ink, width, dashes)


class Panel:
    def __init__(self, left):
        self.left = left

    def x(self, eta):
        return self.left + PANEL * eta

    def y(self, gain):
        return BOTTOM - (BOTTOM - TOP) * (gain - GAIN_MIN) / (GAIN_MAX - GAIN_MIN)

    def axes(self, title):
        parts = [text(self.left, TOP - 18, "gain, " + title, 16, weight="bold")]
        for tick in (1.0, 1.2, 1.4, 1.6, 1.8, 2.0, 2.2):
            parts += [line(self.left, self.y(tick), self.left + PANEL, self.y(tick), GRID),
                      text(self.left - 8, self.y(tick) + 5, "%.1f" % tick, 13, MUTED, "end")]
        for tick in (0.0, 0.2, 0.4, 0.6, 0.8, 1.0):
            parts += [line(self.x(tick), BOTTOM, self.x(tick), BOTTOM + 5, MUTED),
                      text(self.x(tick), BOTTOM + 21, "%.1f" % tick, 13, MUTED, "middle")]
        parts += [line(self.left, BOTTOM, self.left + PANEL, BOTTOM, MUTED),
                  line(self.left, self.y(1.5), self.left + PANEL, self.y(1.5), MUTED, 1.0, "3 4"),
                  text(self.left + PANEL / 2, BOTTOM + 44, "share eta that the cavity returns", 14, MUTED, "middle")]
        return parts

    def curve(self, gain_of, ink):
        etas = [0.99 * i / 200 for i in range(201)]
        path = " ".join("%.1f,%.1f" % (self.x(e), self.y(gain_of(e))) for e in etas)
        return '<polyline points="%s" fill="none" stroke="%s" stroke-width="2"/>' % (path, ink)

    def point(self, p, ink):
        x = self.x(p["eta"])
        low, high = self.y(p["traced"] - p["se"]), self.y(p["traced"] + p["se"])
        return [line(x, low, x, high, ink, 1.5), line(x - 4, low, x + 4, low, ink, 1.5),
                line(x - 4, high, x + 4, high, ink, 1.5),
                '<circle cx="%.1f" cy="%.1f" r="3" fill="#ffffff" stroke="%s" stroke-width="1.5"/>' % (
                    x, self.y(p["traced"]), ink)]


def write_picture(path, cases, points, gain):
    parts = ['<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 %d %d" font-family="sans-serif">' % (WIDTH, HEIGHT),
             '<rect width="100%" height="100%" fill="#ffffff"/>',
             text(20, 30, "Gain of a DBEF over an absorbing polarizer", 19, weight="bold"),
             text(20, 50, "curves: formula; rings: traced, bars of one standard error; d: share depolarized per "
                  "return; dots: a gain of 1.5", 13, MUTED)]
    for i, case in enumerate(cases):
        panel = Panel(LEFT + i * (PANEL + 80))
        parts += panel.axes(case["name"])
        for d in case["ds"]:
            ink = INKS[[0.0, 0.3, 0.6, 1.0].index(d)]
            parts.append(panel.curve(lambda eta, c=case, d=d: gain(c, eta, d), ink))
            for p in points:
                if p["film"] == case["name"] and p["d"] == d:
                    parts += panel.point(p, ink)
        for k, d in enumerate(case["ds"]):
            ink = INKS[[0.0, 0.3, 0.6, 1.0].index(d)]
            x = panel.left + 16
            y = TOP + 18 + 20 * (len(case["ds"]) - 1 - k)
            parts += [line(x, y - 5, x + 24, y - 5, ink, 2), text(x + 32, y, "d = %g" % d, 14)]
    parts.append("</svg>\n")
    path.write_text("\n".join(parts), encoding="utf-8")
