"""Gain of a reflective polarizer over an absorbing one: formula and trace. Started by run.sh; standard library only."""

import argparse
import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile

from gain_picture import write_picture

HERE = pathlib.Path(__file__).resolve().parent

ETAS = [0.3, 0.5, 0.62, 0.67, 0.8, 0.9, 0.95]
# Name, film, absorber in its place, depolarizations. The real film: hemispherical means of the DBEF data at normal
# incidence (configs/data/dbef_hemispherical.csv) and a polarizer of 43 % of natural light.
CASES = [
    {"name": "ideal film", "ds": [0.0, 0.3, 0.6, 1.0],
     "film": {"T": (1.0, 0.0), "R": (0.0, 1.0)}, "absorber": {"k": (1.0, 0.0), "R": 0.0}},
    {"name": "real film", "ds": [0.3, 1.0],
     "film": {"T": (0.887, 0.053), "R": (0.098, 0.932)}, "absorber": {"k": (0.8596, 0.0004), "R": 0.04}},
]


def film_yaml(film):
    """The film of a case as an entry of `films`."""
    return ("{kind: dbef, transmittance_pass: %g, transmittance_block: %g, reflectance_pass: %g, "
            "reflectance_block: %g}" % (film["T"] + film["R"]))


def absorber_yaml(absorber):
    return "{kind: lpp, k1: %g, k2: %g, reflectance: %g}" % (absorber["k"] + (absorber["R"],))


def passed(T, R, eta, d):
    """Light that leaves through the film per unit of natural light from the source: N = 1/2 + C diag(R) N,
    C = eta [[1 - d/2, d/2], [d/2, 1 - d/2]], passed = T . N (docs/dbef_gain.md)."""
    same, other = eta * (1 - d / 2), eta * d / 2
    a, b = 1 - same * R[0], -other * R[1]
    c, e = -other * R[0], 1 - same * R[1]
    det = a * e - b * c
    n_pass, n_block = 0.5 * (e - b) / det, 0.5 * (a - c) / det
    return T[0] * n_pass + T[1] * n_block


def gain(case, eta, d):
    absorber = case["absorber"]
    return (passed(case["film"]["T"], case["film"]["R"], eta, d) /
            passed(absorber["k"], (absorber["R"], absorber["R"]), eta, d))


def check_formula():
    """The matrix against the closed forms of docs/dbef_gain.md."""
    for eta in ETAS:
        for d in (0.0, 0.3, 1.0):
            closed = 1 + (eta * d / 2) / (1 - eta * (1 - d / 2))
            assert abs(gain(CASES[0], eta, d) - closed) < 1e-12
        real, k, R_l = CASES[1]["film"], CASES[1]["absorber"]["k"], CASES[1]["absorber"]["R"]
        closed = sum(real["T"]) / sum(k) * (1 - eta * R_l) / (1 - eta * sum(real["R"]) / 2)
        assert abs(gain(CASES[1], eta, 1.0) - closed) < 1e-12


class Tracer:
    """Runs the program; every run has a seed of its own."""

    def __init__(self, program, photons, seed, scratch):
        self.program, self.photons, self.scratch, self.seed, self.runs = program, photons, scratch, seed, 0

    def efficiency(self, eta, d, film):
        """Share of the source's flux that leaves through the film, with its standard error."""
        self.runs += 1
        out = self.scratch / ("run%d" % self.runs)
        command = [self.program, "simulate", str(HERE / "cavity.yaml"),
                   "--set", "backlight.reflectors.bottom.reflectance=%g" % eta,
                   "--set", "backlight.reflectors.bottom.specular_share=%g" % (1 - d),
                   "--set", "backlight.films[0]=" + film,
                   "--photons", self.photons, "--seed", str(self.seed + self.runs - 1), "--quiet", "-o", str(out)]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            sys.exit("dbef_gain.py: %s\n%s" % (" ".join(command), done.stderr.strip()))
        final = json.loads((out / "result.json").read_text(encoding="utf-8"))["final"]
        return final["efficiency"], final["efficiency_se"]


def traced_gain(tracer, case, eta, d):
    value, se = tracer.efficiency(eta, d, film_yaml(case["film"]))
    base, base_se = tracer.efficiency(eta, d, absorber_yaml(case["absorber"]))
    ratio = value / base
    return ratio, ratio * math.hypot(se / value, base_se / base)


def chi_square_tail(x, degrees):
    """Chance of more than x: the regularized upper incomplete gamma function Q(degrees/2, x/2), by its series."""
    a, y = degrees / 2, x / 2
    term = total = 1 / a
    n = a
    while term > 1e-16 * total:
        n += 1
        term *= y / n
        total += term
    return 1 - total * math.exp(-y + a * math.log(y) - math.lgamma(a)) if y > 0 else 1.0


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", required=True)
    parser.add_argument("--photons", default="1e6")
    parser.add_argument("--seed", type=int, default=1, help="of the first run; each run takes the next")
    parser.add_argument("--out", type=pathlib.Path, required=True)
    arguments = parser.parse_args()
    check_formula()
    points = []
    with tempfile.TemporaryDirectory() as scratch:
        tracer = Tracer(arguments.program, arguments.photons, arguments.seed, pathlib.Path(scratch))
        for case in CASES:
            for d in case["ds"]:
                for eta in ETAS:
                    expected = gain(case, eta, d)
                    value, se = traced_gain(tracer, case, eta, d)
                    points.append({"film": case["name"], "d": d, "eta": eta, "formula": expected, "traced": value,
                                   "se": se, "z": (value - expected) / se})
                    print("%-10s d %.1f  eta %.2f  formula %.4f  traced %.4f +- %.4f  z %+.2f" % (
                        case["name"], d, eta, expected, value, se, points[-1]["z"]))
    arguments.out.mkdir(parents=True, exist_ok=True)
    with open(arguments.out / "dbef_gain.csv", "w", newline="", encoding="utf-8") as file:
        file.write("# gain of a DBEF over an absorbing polarizer (1); eta, d: shares (1); se: standard error\n")
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(points[0].keys())
        for p in points:
            writer.writerow([p["film"]] + ["%.6g" % p[key] for key in list(p)[1:]])
    write_picture(arguments.out / "dbef_gain.svg", CASES, points, gain)
    chi_square = sum(p["z"] ** 2 for p in points)
    largest = max(abs(p["z"]) for p in points)
    chance = chi_square_tail(chi_square, len(points))
    print("chi-square %.1f for %d points (chance of more: %.2f), largest |z| %.2f" % (
        chi_square, len(points), chance, largest))
    print("wrote %s and dbef_gain.csv" % (arguments.out / "dbef_gain.svg"))
    # 1e-3 of false alarm.
    return 0 if chance > 1e-3 else 1


if __name__ == "__main__":
    sys.exit(main())
