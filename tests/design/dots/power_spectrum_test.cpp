#include "design/dots/power_spectrum.h"

#include <gtest/gtest.h>

#include "design/dots/dot_index.h"
#include "design/dots/fourier_sums.h"
#include "tests/design/dots/dot_samples.h"

namespace evenglow::tests {
namespace {

using namespace evenglow::design;

PowerSpectrum spectrum_of(const core::DotPattern& dots) {
  const FreeArea free = whole_plate();
  return power_spectrum(sample_windows(index_dots(dots, free.bounds(), 2), free, 400.0), 2);
}

TEST(PowerSpectrum, OfDotsByChanceIsOne) {
  // About 6000 frequencies from 0.1 to 0.5 in windows that overlap by half: 4 standard errors are below 0.1.
  const PowerSpectrum spectrum = spectrum_of(random_dots(20000, 4));
  EXPECT_NEAR(spectrum.low_power, 1.0, 0.1);
  EXPECT_LT(spectrum.peak_power, 1.3);
  EXPECT_LT(spectrum.direction_contrast, 1.3);
}

TEST(PowerSpectrum, OfALatticeHasDirections) {
  const PowerSpectrum spectrum = spectrum_of(lattice_pattern(0.1));
  EXPECT_GT(spectrum.direction_contrast, 5.0);
  EXPECT_GT(spectrum.peak_power, 5.0);
  EXPECT_GT(std::max(spectrum.radial[19], spectrum.radial[20]), 3.0);
}

TEST(FourierSums, AgreeWithTheirDefinition) {
  const std::vector<double> x = {0.1, 0.55, 0.73}, y = {0.9, 0.2, 0.31}, w = {1.0, 2.0, 0.5};
  const auto sums = fourier_sums(x, y, w, {-3.0, 0.5, 9}, {1.0, 0.25, 5});
  for (int row = 0; row < 5; ++row) {
    for (int column = 0; column < 9; ++column) {
      std::complex<double> expected = 0.0;
      for (std::size_t i = 0; i < 3; ++i)
        expected += w[i] * std::polar(1.0, -2.0 * M_PI * ((-3.0 + 0.5 * column) * x[i] + (1.0 + 0.25 * row) * y[i]));
      EXPECT_NEAR(std::abs(expected - std::complex<double>(sums(row, column))), 0.0, 1e-5);
    }
  }
}

}  // namespace
}  // namespace evenglow::tests
