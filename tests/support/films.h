#pragma once

#include <string>

#include "core/base/units.h"
#include "tracer/films/dbef.h"
#include "tracer/films/diffuser.h"

namespace evenglow::tests {

inline std::string data_file(const std::string& name) {
  return std::string(EVENGLOW_SOURCE_DIR) + "/configs/data/" + name;
}

/// The tabulated film of configs/data, normalized; pass axis at `axis` (rad).
inline tracer::TabulatedDbef data_dbef(double axis) {
  const auto totals = tracer::HemisphericalTable::read(data_file("dbef_hemispherical.csv"));
  return tracer::TabulatedDbef(tracer::BsdfTable::read(data_file("dbef.csv")), 550.0, &totals, axis);
}

inline constexpr double kRad = core::kRadPerDeg;

}  // namespace evenglow::tests
