#include "tracer/optics/material.h"

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace evenglow::tracer {
namespace {

/// Indices that the fit of Sultanova et al. (2009) gives.
TEST(Material, Dispersion) {
  EXPECT_NEAR(material("pmma", 450.0).refractive_index, 1.5006, 5e-5);
  EXPECT_NEAR(material("pmma", 550.0).refractive_index, 1.4926, 5e-5);
  EXPECT_NEAR(material("polycarbonate", 450.0).refractive_index, 1.6078, 5e-5);
  EXPECT_NEAR(material("polycarbonate", 588.0).refractive_index, 1.5848, 1e-4);
  EXPECT_GT(material("pmma", 450.0).refractive_index, material("pmma", 650.0).refractive_index);
}

/// A light guide loses a few per cent a metre, not 98 %.
TEST(Material, BulkLossPerMillimetre) {
  EXPECT_NEAR(material("pmma", 550.0).absorption, 3e-5, 2e-5);
  EXPECT_NEAR(material("polycarbonate", 550.0).absorption, 3e-4, 1e-12);
}

TEST(Material, UnknownNames) {
  EXPECT_THROW(material("glas", 550.0), core::Error);
  for (const std::string& name : material_names()) EXPECT_NO_THROW(material(name, 550.0));
}

}  // namespace
}  // namespace evenglow::tracer
