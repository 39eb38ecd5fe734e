#include "tests/support/z_test.h"

namespace evenglow::tests {

double two_sided_z(double alpha) {
  // erfc(z / sqrt 2) = alpha, by halving: plain and exact enough for a test.
  double low = 0.0;
  double high = 40.0;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (std::erfc(middle / std::sqrt(2.0)) > alpha ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace evenglow::tests
