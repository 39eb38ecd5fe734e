#include "design/report/energy_rows.h"

#include <gtest/gtest.h>

#include "tests/design/report_samples.h"

namespace evenglow::design {
namespace {

TEST(EnergyRows, TheTopIsFirstThenTheGreatest) {
  Report r = samples::report();
  r.energy.escaped.back().share.value = 0.2;  // less than the sheet takes
  r.energy.absorbed.back().share.value = 0.55;
  const EnergyRows account({&r});
  ASSERT_EQ(account.rows().size(), 9U);
  EXPECT_EQ(account.rows()[0].label, "leaves by the top");
  EXPECT_EQ(account.rows()[1].label, "absorbed: white sheet");
  EXPECT_EQ(account.rows()[2].label, "absorbed: plate");
  EXPECT_EQ(account.rows()[3].fate, Fate::lost);
  EXPECT_NEAR(account.sum(0), 1.0, 1e-12);
}

TEST(EnergyRows, PartsOfOneNameMeetAndOthersAreMissing) {
  Report a = samples::report("a");
  Report b = samples::report("b");
  b.energy.absorbed = {{"plate", {0.3, 0.001}}, {"plate", {0.05, 0.001}}};
  const EnergyRows account({&a, &b});
  const auto& rows = account.rows();
  EXPECT_EQ(rows[1].label, "absorbed: plate");
  EXPECT_EQ(rows[1].shares[0]->value, 0.1);
  EXPECT_EQ(rows[1].shares[1]->value, 0.3);
  EXPECT_EQ(rows[2].label, "absorbed: white sheet");
  EXPECT_FALSE(rows[2].shares[1].has_value());
  EXPECT_NEAR(account.sum(1), 1.0, 1e-12);  // the second plate has a row of its own
}

TEST(EnergyRows, HaveClassesOfTheStyleSheet) {
  EXPECT_EQ(energy_class(0), "e0");
  EXPECT_EQ(energy_class(10), "e10");
  EXPECT_EQ(energy_class(500), "e10");
}

}  // namespace
}  // namespace evenglow::design
