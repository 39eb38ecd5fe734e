#pragma once

#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>

/// Photometric files written from the definitions of their formats, for tests.
namespace evenglow::tests {

/// Intensity (cd) at theta, phi in degrees.
using Intensity = std::function<double(double theta_deg, double phi_deg)>;

inline std::vector<double> steps(double first, double last, double step) {
  std::vector<double> result;
  for (int i = 0; first + i * step <= last + 1e-9; ++i) result.push_back(first + i * step);
  return result;
}

/// IES LM-63.
struct Ies {
  std::string labels = "IESNA:LM-63-2002\n[TEST] none\n[MANUFAC] nobody\n";
  std::string tilt = "TILT=NONE\n";
  std::string lamps = "1 -1";
  double multiplier = 1.0;
  std::string type = "1 2";
  std::string factors = "1 1 0.1";
  std::vector<double> vertical = steps(0, 90, 1);
  std::vector<double> horizontal{0};
  Intensity intensity = [](double, double) { return 1.0; };

  std::string text() const {
    std::string s = labels + tilt;
    s += fmt::format("{} {} {} {} {} 0.001 0.003 0\n{}\n", lamps, multiplier, vertical.size(), horizontal.size(), type,
                     factors);
    for (const double v : vertical) s += fmt::format("{} ", v);
    s += "\n";
    for (const double h : horizontal) s += fmt::format("{} ", h);
    s += "\n";
    for (const double h : horizontal) {
      int n = 0;
      for (const double v : vertical) s += fmt::format("{}{}", intensity(v, h), ++n % 10 == 0 ? "\n" : " ");
      s += "\n";
    }
    return s;
  }
};

/// EULUMDAT.
struct Eulumdat {
  int symmetry = 1;
  std::vector<double> planes{0};
  std::vector<double> gammas = steps(0, 180, 1);
  std::string factor = "1";
  std::string lamps = "1\n1\nLED\n1000\n3000K\n80\n0.1\n";   // one set: number, type, flux, color, rendering, power
  Intensity intensity = [](double, double) { return 1.0; };  // cd per 1000 lm

  /// The planes whose intensities the file holds.
  std::vector<double> given() const {
    const std::size_t n = planes.size();
    const std::size_t first = symmetry == 3 ? 3 * n / 4 : 0;
    const std::size_t count = symmetry == 0 ? n : symmetry == 1 ? 1 : symmetry == 4 ? n / 4 + 1 : n / 2 + 1;
    std::vector<double> result;
    for (std::size_t i = 0; i < count; ++i) result.push_back(planes[(first + i) % n]);
    return result;
  }

  std::string text() const {
    std::string s = fmt::format("nobody\r\n1\r\n{}\r\n{}\r\n0\r\n{}\r\n0\r\n", symmetry, planes.size(), gammas.size());
    s += "report\r\nname \xe9t\xe9\r\nnumber\r\nfile\r\ndate\r\n";
    for (int line = 13; line <= 21; ++line) s += "1\r\n";
    s += "100\r\n100\r\n" + factor + "\r\n0\r\n" + lamps;
    for (int line = 0; line < 10; ++line) s += "0\r\n";
    for (const double c : planes) s += fmt::format("{}\r\n", c);
    for (const double g : gammas) s += fmt::format("{}\r\n", g);
    for (const double c : given()) {
      for (const double g : gammas) s += fmt::format("{}\r\n", intensity(g, c));
    }
    return s;
  }
};

}  // namespace evenglow::tests
