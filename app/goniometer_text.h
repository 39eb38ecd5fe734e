#pragma once

#include <string>

#include "tracer/goniometer/goniometer.h"

namespace evenglow::app {

/// What a goniometer run is told with.
struct GoniometerFacts {
  std::string title;
  std::string command;
  std::string run_file_sha256;
  std::uint64_t seed = 1;
  std::uint64_t photons_per_setting = 0;
};

/// What must be known wherever the default film is compared with the published measurements.
extern const char* const kFittedCaveat;

/// Rows of one kind in the form of Tables 1 and 2 of the DBEF paper: a comment with units, then
/// `psi_deg,theta_deg,illumination,measured_cd_m2,published_cd_m2,table_cd_m2,film_cd_m2,traced_cd_m2,traced_se_cd_m2,
/// expected_hits,hits,z`; entries that there are not are empty.
std::string goniometer_csv(const tracer::GoniometerSpec& spec, const tracer::GoniometerResult& result,
                           tracer::ScatterKind kind);
std::string goniometer_json(const tracer::GoniometerSpec& spec, const tracer::GoniometerResult& result,
                            const GoniometerFacts& facts);
/// For stdout: agreement of tracing with evaluation, then metrics against the measured columns.
std::string goniometer_summary(const tracer::GoniometerSpec& spec, const tracer::GoniometerResult& result);

}  // namespace evenglow::app
