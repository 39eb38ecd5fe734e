#!/usr/bin/env python3
"""Drives the report of a comparison in headless Chromium, as a reader would, and holds what it shows against the
result files beside it.

    report_in_browser.py DIR [--pictures OUT] [--chromium PROGRAM]

DIR is what `evenglow compare` wrote, with the formats json, csv and html. Exit code 0: all as it should be, 1: a line on
stderr for each fault. Needs no network and no package besides Chromium: it talks to it over its debugging pipe.
"""

import argparse
import base64
import json
import os
import re
import select
import subprocess
import sys
import tempfile
import time
from pathlib import Path


class Browser:
    """Chromium on a pipe (DevTools protocol: JSON messages that end in a zero byte)."""

    def __init__(self, program):
        self.folder = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        to_read, self.to_browser = os.pipe()
        self.from_browser, to_write = os.pipe()

        def place_pipes():
            ends = os.dup(to_read), os.dup(to_write)
            high = [os.dup2(end, 200 + i) for i, end in enumerate(ends)]
            os.dup2(high[0], 3)
            os.dup2(high[1], 4)

        self.process = subprocess.Popen(
            [program, "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--no-first-run",
             "--disable-background-networking", "--remote-debugging-pipe", "--user-data-dir=" + self.folder.name],
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, close_fds=False,
            preexec_fn=place_pipes)
        os.close(to_read)
        os.close(to_write)
        self.buffer = b""
        self.count = 0
        self.session = None
        self.events = []
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self.session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(domain + ".enable")

    def post(self, method, **parameters):
        self.count += 1
        message = {"id": self.count, "method": method, "params": parameters}
        if self.session:
            message["sessionId"] = self.session
        os.write(self.to_browser, json.dumps(message).encode() + b"\0")
        return self.count

    def call(self, method, **parameters):
        number = self.post(method, **parameters)
        while True:
            answer = self.receive(60)
            if answer.get("id") == number:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']}")
                return answer["result"]

    def receive(self, patience):
        end = time.monotonic() + patience
        while b"\0" not in self.buffer:
            if not select.select([self.from_browser], [], [], max(0.0, end - time.monotonic()))[0]:
                raise RuntimeError("the browser does not answer")
            piece = os.read(self.from_browser, 1 << 20)
            if not piece:
                raise RuntimeError("the browser has ended")
            self.buffer += piece
        raw, self.buffer = self.buffer.split(b"\0", 1)
        message = json.loads(raw)
        if "method" in message:
            self.events.append(message)
            if message["method"] == "Page.javascriptDialogOpening":  # the page waits for an answer
                self.post("Page.handleJavaScriptDialog", accept=True)
        return message

    def open(self, page):
        begin = time.monotonic()
        self.call("Page.navigate", url=page.as_uri())
        while not any(event["method"] == "Page.loadEventFired" for event in self.events):
            self.receive(60)
        self.run("1")
        return time.monotonic() - begin

    def run(self, script):
        answer = self.call("Runtime.evaluate", expression=script, returnByValue=True)
        if "exceptionDetails" in answer:
            raise RuntimeError(f"{script}: {answer['exceptionDetails']}")
        return answer["result"].get("value")

    def place(self, selector, u=0.5, v=0.5):
        """Scrolls an element to the middle of the window; the point (u, v) of it, from its upper left corner."""
        quoted = json.dumps(selector)
        self.run(f"document.querySelector({quoted}).scrollIntoView({{block: 'center'}})")
        left, top, width, height = self.run(
            f"(function () {{ var b = document.querySelector({quoted}).getBoundingClientRect();"
            " return [b.left, b.top, b.width, b.height]; }())")
        return left + u * width, top + v * height

    def move(self, selector, u=0.5, v=0.5):
        x, y = self.place(selector, u, v)
        self.call("Input.dispatchMouseEvent", type="mouseMoved", x=x, y=y)

    def click(self, selector, u=0.5, v=0.5):
        x, y = self.place(selector, u, v)
        for kind in ("mouseMoved", "mousePressed", "mouseReleased"):
            self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", clickCount=1)

    def key(self, name):
        for kind in ("keyDown", "keyUp"):
            self.call("Input.dispatchKeyEvent", type=kind, key=name, code=name)

    def text(self, selector):
        return self.run(f"document.querySelector({json.dumps(selector)}).textContent")

    def close(self):
        try:
            self.session = None
            self.call("Browser.close")
        except (RuntimeError, OSError):
            self.process.kill()
        self.process.wait()
        self.folder.cleanup()


class Table:
    """A matrix of a result folder: rows = y from the front."""

    def __init__(self, path):
        lines = path.read_text().splitlines()
        self.rows = [[float(value) for value in line.split(",")] for line in lines if not line.startswith("#")]
        self.nx, self.ny = len(self.rows[0]), len(self.rows)
        cell = re.search(r"cell (\S+) mm x (\S+) mm; first corner at x (\S+) mm, y (\S+) mm", lines[0])
        self.dx, self.dy, self.x0, self.y0 = (float(text) for text in cell.groups())

    def at(self, cell):
        return self.rows[cell[1]][cell[0]]

    def all(self):
        return [value for row in self.rows for value in row]


class Variant:
    def __init__(self, folder):
        self.name = folder.name
        self.result = json.loads((folder / "result.json").read_text())
        self.luminance = Table(folder / "luminance.csv")
        self.error = Table(folder / "luminance_se.csv")
        self.density = Table(folder / "density.csv")


NUMBER = r"[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?"


def numbers(text):
    return [float(number) for number in re.findall(NUMBER, text.replace("\u2009", "").replace("\u2212", "-"))]


class Faults:
    def __init__(self):
        self.lines = []
        self.checks = 0

    def expect(self, good, what):
        self.checks += 1
        if not good:
            self.lines.append(what)

    def near(self, shown, wanted, tolerance, what):
        self.expect(abs(shown - wanted) <= tolerance, f"{what}: shown {shown}, wanted {wanted} +- {tolerance}")


def rounding(value, error=0.0):
    """How far a shown number may be from the exact one: four digits, or two digits of its error."""
    return max(0.6e-3 * abs(value), 0.06 * error) + 1e-12


def canvas(group, index):
    return f"#{group} figure.map:nth-of-type({index + 1}) canvas"


def read(group, index):
    return f"#{group} figure.map:nth-of-type({index + 1}) .read"


def point(table, cell):
    return (cell[0] + 0.5) / table.nx, 1.0 - (cell[1] + 0.5) / table.ny


def check_hover(browser, faults, variants):
    for index, variant in enumerate(variants):
        table = variant.luminance
        for cell in ((0, 0), (table.nx - 1, 1), (table.nx // 3, table.ny - 1)):
            browser.move(canvas("luminance-maps", index), *point(table, cell))
            text = browser.text(read("luminance-maps", index))
            shown = numbers(text)
            what = f"luminance of {variant.name} at cell {cell} ({text})"
            faults.expect("cd/m" in text and "\u00b1" in text and len(shown) >= 4, what)
            if len(shown) < 4:
                continue
            faults.near(shown[0], table.x0 + (cell[0] + 0.5) * table.dx, 0.06, what + " x")
            faults.near(shown[1], table.y0 + (cell[1] + 0.5) * table.dy, 0.06, what + " y")
            error = variant.error.at(cell)
            faults.near(shown[2], table.at(cell), rounding(table.at(cell), error), what)
            faults.near(shown[3], error, 0.06 * error, what + " error")


def section_values(text, names):
    """The value of each map in the read-out of the sections."""
    values = {}
    for name in names:
        found = re.search(re.escape(name) + r" (" + NUMBER + r")", text)
        values[name] = float(found.group(1)) if found else None
    return values


def check_sections(browser, faults, variants):
    cut = "[data-cut='luminance-maps']"
    table = variants[0].luminance
    chosen = (table.nx // 4, table.ny // 5)
    names = sorted((variant.name for variant in variants), key=len, reverse=True)

    def expect_cell(cell, what):
        faults.expect(browser.run(f"document.querySelector(\"{cut}\").dataset.cell") == f"{cell[0]},{cell[1]}", what)
        shown = section_values(browser.text(cut + " .cutread"), names)
        for variant in variants:
            wanted = variant.luminance.at(cell)
            faults.expect(shown[variant.name] is not None, what + ": no value of " + variant.name)
            if shown[variant.name] is not None:
                faults.near(shown[variant.name], wanted, rounding(wanted, variant.error.at(cell)),
                            what + " " + variant.name)

    browser.click(canvas("luminance-maps", 0), *point(table, chosen))
    expect_cell(chosen, "a click chooses the cell")
    browser.move(canvas("luminance-maps", len(variants) - 1), *point(table, (2, 1)))
    expect_cell((2, 1), "hovering shows the cell")
    browser.move("h1")
    expect_cell(chosen, "leaving goes back to the chosen cell")
    browser.run(f"document.querySelector('{canvas('luminance-maps', 0)}').focus()")
    browser.key("ArrowRight")
    browser.key("ArrowUp")
    expect_cell((chosen[0] + 1, chosen[1] + 1), "arrow keys move the cell")

    # The curves: the height of each point is the value of its cell, on the axis that the ticks tell.
    cell = (chosen[0] + 1, chosen[1] + 1)
    for chart, count in ((0, table.nx), (1, table.ny)):
        svg = f"document.querySelectorAll(\"{cut} svg\")[{chart}]"
        ticks = browser.run(f"Array.from({svg}.querySelectorAll('text[text-anchor=end]'), function (t) {{"
                            " return [Number(t.textContent), Number(t.getAttribute('y')) - 4]; })")
        paths = browser.run(f"Array.from({svg}.querySelectorAll('path'), function (p) {{"
                            " return p.getAttribute('d'); })")
        faults.expect(len(paths) == len(variants), f"a curve for each variant, got {len(paths)}")
        (a, ya), (b, yb) = ticks[0], ticks[-1]
        for variant, path in zip(variants, paths):
            places = re.findall(r"[ML]([-\d.]+),([-\d.]+)", path)
            faults.expect(len(places) == count, f"{count} points of {variant.name}, got {len(places)}")
            for i in range(0, len(places), 3):
                value = a + (float(places[i][1]) - ya) / (yb - ya) * (b - a)
                wanted = variant.luminance.at((i, cell[1]) if chart == 0 else (cell[0], i))
                faults.near(value, wanted, 0.12 * abs((b - a) / (yb - ya)) + rounding(wanted),
                            f"section {chart} of {variant.name} at {i}")


def bar(browser, group, index):
    spans = browser.run(f"Array.from(document.querySelectorAll('#{group} figure.map')[{index}]"
                        ".querySelectorAll('.bar span'), function (s) { return s.textContent; })")
    return [numbers(text)[0] for text in spans]


def check_scales(browser, faults, variants):
    every = [value for variant in variants for value in variant.luminance.all()]
    button = "[data-scales='luminance-maps']"

    def expect_bars(wanted, what):
        for index, values in enumerate(wanted):
            low, high = bar(browser, "luminance-maps", index)
            faults.near(low, min(values), rounding(min(values)), f"{what}, low end {index}")
            faults.near(high, max(values), rounding(max(values)), f"{what}, high end {index}")

    own = [variant.luminance.all() for variant in variants]
    expect_bars([every] * len(variants), "one scale at first")
    browser.click(button)
    expect_bars(own, "a scale for each map")
    browser.click(button)
    expect_bars([every] * len(variants), "back to one scale")


def pixel(browser, group, index, table, cell):
    return browser.run(f"Array.from(document.querySelectorAll('#{group} figure.map')[{index}].querySelector('canvas')"
                       f".getContext('2d').getImageData({cell[0]}, {table.ny - 1 - cell[1]}, 1, 1).data)")[:3]


def rainbow(share):
    def ramp(center):
        return min(1.0, max(0.0, 1.5 - abs(4.0 * share - center)))
    return [round(255 * ramp(center)) for center in (3.0, 2.0, 1.0)]


def check_colors(browser, faults, variants):
    table = variants[0].luminance
    cell = (table.nx // 2, table.ny // 2)
    every = [value for variant in variants for value in variant.luminance.all()]
    share = round(255 * (table.at(cell) - min(every)) / (max(every) - min(every))) / 255
    before = pixel(browser, "luminance-maps", 0, table, cell)
    browser.click(".tools [data-palette]")
    seen = pixel(browser, "luminance-maps", 0, table, cell)
    for a, b in zip(seen, rainbow(share)):
        faults.near(a, b, 5, f"rainbow color of cell {cell}")
    browser.click(".tools [data-palette]")
    faults.expect(pixel(browser, "luminance-maps", 0, table, cell) == before, "colors go back")
    faults.expect(before != seen, "the switch changes the colors")


def check_relations(browser, faults, variants):
    base = variants[0]
    for index, variant in enumerate(variants[1:]):
        if variant.luminance.nx != base.luminance.nx or variant.luminance.ny != base.luminance.ny:
            continue
        flux = base.result["energy"]["emitted_lm"] / variant.result["energy"]["emitted_lm"]
        cell = (base.luminance.nx // 3, base.luminance.ny // 3)
        a, b = variant.luminance.at(cell), base.luminance.at(cell)
        ea, eb = variant.error.at(cell), base.error.at(cell)
        wanted = {"ratio-maps": (flux * a / b, flux * (ea ** 2 + (a / b * eb) ** 2) ** 0.5 / b),
                  "difference-maps": (flux * a - b, ((flux * ea) ** 2 + eb ** 2) ** 0.5)}
        for group, (value, error) in wanted.items():
            browser.move(canvas(group, index), *point(base.luminance, cell))
            shown = numbers(browser.text(read(group, index)))
            faults.near(shown[2], value, rounding(value, error), f"{group} of {variant.name}")
            faults.near(shown[3], error, 0.06 * error, f"{group} of {variant.name}, error")
        cell = (base.density.nx // 3, base.density.ny // 3)
        value = variant.density.at(cell) - base.density.at(cell)
        browser.move(canvas("density-difference-maps", index), *point(base.density, cell))
        shown = numbers(browser.text(read("density-difference-maps", index)))
        faults.near(shown[2], value, rounding(value) + 1e-5, f"density difference of {variant.name}")


def check_figures(browser, faults, variants, comparison):
    rows = browser.run("Array.from(document.querySelectorAll('table')[1].querySelectorAll('tbody tr'), function (r) {"
                       " return Array.from(r.children, function (c) { return c.textContent; }); })")
    figures = {row[0]: row[1:] for row in rows}
    for index, variant in enumerate(variants):
        final = variant.result["final"]
        for name, key, scale in (("mean luminance", "luminance_mean_cd_m2", 1), ("efficiency", "efficiency", 100),
                                 ("RMS, noise taken off", "rms_corrected", 100), ("RMS, raw", "rms", 100),
                                 ("uniformity of 9 spots", "uniformity_9", 100),
                                 ("uniformity of 13 spots", "uniformity_13", 100)):
            error = final.get({"luminance_mean_cd_m2": "luminance_mean_se"}.get(key, key + "_se"), 0.0) or 0.0
            shown = numbers(figures[name][index])[0]
            faults.near(shown, scale * final[key], rounding(scale * final[key], scale * error),
                        f"{name} of {variant.name}")
    cards = browser.run("Array.from(document.querySelectorAll('.card'), function (c) { return c.textContent; })")
    for name, ratio in comparison["ratio"].items():
        card = next((text for text in cards if name in text), "")
        shown = numbers(card.split(name)[-1])
        faults.expect(bool(shown), "a card of " + name)
        if shown:
            faults.near(shown[0], ratio["luminance"], rounding(ratio["luminance"], ratio["luminance_se"]), name)


def check_energy(browser, faults, variants):
    for index, variant in enumerate(variants):
        texts = browser.run(f"Array.from(document.querySelectorAll('svg.energy')[{index}].querySelectorAll('title'),"
                            " function (t) { return t.textContent; })")
        shown = {text.rsplit(": ", 1)[0]: numbers(text.rsplit(": ", 1)[1]) for text in texts}
        energy = variant.result["energy"]
        wanted = {"leaves by the " + side: share for side, share in energy["escaped"].items()}
        wanted.update({"absorbed: " + part: share for part, share in energy["absorbed"].items()})
        for name, share in wanted.items():
            if share <= 0.0:
                faults.expect(name not in shown, f"{name} has no share and no band")
            else:
                faults.expect(name in shown, f"a band of {name}")
                faults.near(shown.get(name, [0])[0], 100 * share, rounding(100 * share, 0.5), f"{variant.name}, {name}")


def check_convergence(browser, faults, variants):
    figure = "figure.curves"
    count = max(len(variant.result["steps"]) for variant in variants)
    for step in {0, count - 1}:
        browser.move(figure + " svg", 0.02 + 0.98 * (0.08 if step == 0 else 0.97), 0.5)
        text = browser.text(figure + " .read")
        faults.expect(text.startswith(f"step {step}:"), f"read-out of step {step}, got {text}")
        for variant in variants:
            if step >= len(variant.result["steps"]):
                continue
            record = variant.result["steps"][step]
            found = re.search("(?:^|[:;]) " + re.escape(variant.name) + f", raw ({NUMBER})", text)
            faults.expect(found is not None, f"raw RMS of {variant.name} in {text}")
            if found:
                faults.near(float(found.group(1)), 100 * record["rms"], rounding(100 * record["rms"]),
                            f"raw RMS of {variant.name} in step {step}")


def check_quiet(browser, faults, page):
    for event in browser.events:
        parameters = event["params"]
        if event["method"] == "Runtime.exceptionThrown":
            faults.expect(False, "exception: " + json.dumps(parameters)[:300])
        elif event["method"] == "Page.javascriptDialogOpening":
            faults.expect(False, "dialog: " + parameters["message"][:300])
        elif event["method"] == "Runtime.consoleAPICalled":
            faults.expect(False, "console: " + json.dumps(parameters)[:300])
        elif event["method"] == "Log.entryAdded" and "willReadFrequently" not in parameters["entry"]["text"]:
            # (That one is advice on how this script reads pixels.)
            faults.expect(False, "log: " + json.dumps(parameters)[:300])
        elif event["method"] == "Network.requestWillBeSent":
            url = parameters["request"]["url"]
            faults.expect(url.split("#")[0] == page.as_uri() or url.startswith("data:"), "request: " + url)


def check_narrow(browser, faults):
    for width in (400, 1280):
        browser.call("Emulation.setDeviceMetricsOverride", width=width, height=900, deviceScaleFactor=1, mobile=False)
        seen = browser.run("document.documentElement.scrollWidth")
        faults.expect(seen <= width, f"nothing stands out of a window of {width} px, got {seen}")


def take_pictures(browser, folder):
    folder.mkdir(parents=True, exist_ok=True)
    for name, width, scheme in (("light", 1280, "light"), ("dark", 1280, "dark"), ("narrow", 400, "light")):
        browser.call("Emulation.setDeviceMetricsOverride", width=width, height=900, deviceScaleFactor=1, mobile=False)
        browser.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])
        browser.run("window.scrollTo(0, 0)")
        height = browser.run("document.documentElement.scrollHeight")
        picture = browser.call("Page.captureScreenshot", captureBeyondViewport=True,
                               clip={"x": 0, "y": 0, "width": width, "height": min(height, 15000), "scale": 1})
        (folder / (name + ".png")).write_bytes(base64.b64decode(picture["data"]))
    paper = browser.call("Page.printToPDF", printBackground=True, paperWidth=8.27, paperHeight=11.69)
    (folder / "print.pdf").write_bytes(base64.b64decode(paper["data"]))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--pictures", type=Path)
    parser.add_argument("--chromium", default="chromium")
    options = parser.parse_args()
    folder = options.folder.resolve()
    page = folder / "report.html"
    comparison = json.loads((folder / "compare.json").read_text())
    variants = [Variant(folder / name) for name in comparison["variants"]]
    faults = Faults()
    browser = Browser(options.chromium)
    try:
        browser.call("Emulation.setDeviceMetricsOverride", width=1280, height=900, deviceScaleFactor=1, mobile=False)
        seconds = browser.open(page)
        size = page.stat().st_size
        faults.expect(seconds < 2.0, f"interactive in less than 2 s, got {seconds:.2f} s")
        faults.expect(size < 5e6, f"less than 5 MB, got {size}")
        check_hover(browser, faults, variants)
        check_sections(browser, faults, variants)
        check_scales(browser, faults, variants)
        check_colors(browser, faults, variants)
        check_relations(browser, faults, variants)
        check_figures(browser, faults, variants, comparison)
        check_energy(browser, faults, variants)
        check_convergence(browser, faults, variants)
        check_narrow(browser, faults)
        if options.pictures:
            take_pictures(browser, options.pictures)
        check_quiet(browser, faults, page)
    finally:
        browser.close()
    for line in faults.lines:
        print(line, file=sys.stderr)
    print(f"{faults.checks} checks, {len(faults.lines)} faults; {size / 1e6:.2f} MB, interactive in {seconds:.2f} s")
    return 1 if faults.lines else 0


if __name__ == "__main__":
    sys.exit(main())
