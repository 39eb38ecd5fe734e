#include "tracer/polarized_bsdf/table_limits.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "tests/support/films.h"

namespace evenglow::tracer {
namespace {

/// The same tau_min = tau_max = S / 2 into all directions: R = pi S / 2.
BsdfTable flat(double reflectance) {
  const double tau = reflectance / core::kPi;
  return BsdfTable::parse(
      fmt::format("# degrees, nm, 1/sr\nkind,psi_deg,sigma_deg,phi_deg,theta_deg,lambda_nm,tau_min,tau_max,delta_deg\n"
                  "BRDF,0,30,0,0,550,{},{},0\n",
                  tau, tau),
      "flat.csv");
}

std::string refusal(double reflectance) {
  const BsdfTable table = flat(reflectance);
  try {
    require_light(table);
    require_energy(table, incidence_energies(table, 1.58));
  } catch (const core::ConfigError& error) {
    EXPECT_EQ(error.faults().size(), 1u);
    return error.what();
  }
  return "accepted";
}

TEST(TableLimits, UpToFivePercentAreScaledDownMoreIsRefused) {
  EXPECT_EQ(refusal(0.5), "accepted");
  EXPECT_EQ(refusal(1.045), "accepted");
  EXPECT_EQ(refusal(1.055),
            "flat.csv: must give R + T of at most 1.05 for any polarization (or stand beside hemispherical), got 1.055 "
            "at psi 0 sigma 30 lambda 550");
}

TEST(TableLimits, AFilmThatDoesNothingIsRefused) {
  EXPECT_EQ(refusal(0.0), "flat.csv: must reflect or transmit, got tau 0 everywhere");
  EXPECT_TRUE(is_black(flat(0.0)));
  EXPECT_FALSE(is_black(flat(1e-9)));
}

TEST(TableLimits, TheSuppliedTableKeepsThem) {
  const BsdfTable table = BsdfTable::read(tests::data_file("dbef.csv"));
  EXPECT_NO_THROW(require_energy(table, incidence_energies(table, 1.58)));
}

}  // namespace
}  // namespace evenglow::tracer
