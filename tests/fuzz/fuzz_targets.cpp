#include <cstdlib>

#include "app/run_file.h"
#include "app/tolerance_run.h"
#include "core/base/error.h"
#include "core/config/config_node.h"
#include "core/dots/dot_csv.h"
#include "core/dots/dot_dxf.h"
#include "design/engine/checkpoint.h"
#include "design/engine/state_file.h"
#include "design/report/batch_table.h"
#include "design/tolerance/figures.h"
#include "tests/app/tiny_run.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/support/photometric_files.h"
#include "tests/support/ray_files.h"
#include "tests/support/temp_folder.h"
#include "tracer/films/scatter_table.h"
#include "tracer/polarized_bsdf/bsdf_table.h"
#include "tracer/polarized_bsdf/film_readings.h"
#include "tracer/polarized_bsdf/hdf5_table.h"
#include "tracer/polarized_bsdf/stored_table.h"
#include "tracer/sources/eulumdat_file.h"
#include "tracer/sources/ies_file.h"
#include "tracer/sources/intensity_csv.h"
#include "tracer/sources/ray_file_layout.h"
#include "tracer/sources/ray_sampler.h"

namespace evenglow::tests {
namespace {

std::filesystem::path source(const std::string& name) {
  return std::filesystem::path(EVENGLOW_SOURCE_DIR) / name;
}

/// A file of these bytes, for readers that open it themselves.
std::filesystem::path as_file(std::string_view bytes, const std::string& name) {
  static const TempFolder folder;
  write_text(folder / name, std::string(bytes));
  return folder / name;
}

void read_run_file(std::string_view bytes) {
  static const TempFolder empty;
  auto document = core::ConfigDocument::parse(std::string(bytes), (empty / "run.yaml").string());
  const auto variants = document.variants();
  document.sweep();
  app::read_keys(document, app::Purpose::kDesign);
  document.finish();
}

void read_film_table(std::string_view bytes) {
  tracer::BsdfTable::parse(bytes, "table.csv");
}

void read_hdf5(std::string_view bytes) {
  tracer::parse_hdf5_table(bytes, "table.h5");
}

void read_stored_csv(std::string_view bytes) {
  tracer::parse_csv_table(bytes, "table.csv");
}

void read_readings(std::string_view bytes) {
  tracer::FilmReadings::parse(bytes, "readings.csv");
}

void read_ies(std::string_view bytes) {
  tracer::read_ies_file(as_file(bytes, "led.ies"));
}

void read_eulumdat(std::string_view bytes) {
  tracer::read_eulumdat_file(as_file(bytes, "led.ldt"));
}

void read_intensity(std::string_view bytes) {
  tracer::read_intensity_csv(as_file(bytes, "led.csv"));
}

void read_rays(std::string_view bytes, const std::string& name, const std::string& format) {
  const auto file = as_file(bytes, name);
  const auto layout = tracer::read_ray_file_head(file, format);
  const auto flux = tracer::scan_rays(file, layout, tracer::RayFileAxis::kPlusZ);
  const tracer::RaySampler sampler(file, layout, tracer::RayFileAxis::kPlusZ, flux);
  for (std::uint64_t i = 0; i < 20; ++i) {
    core::PhotonRng rng({1, 0, 0}, i);
    sampler.sample(rng);
  }
}

void read_tm25(std::string_view bytes) {
  read_rays(bytes, "led.tm25ray", "tm25");
}

void read_zemax(std::string_view bytes) {
  read_rays(bytes, "led.dat", "zemax");
}

/// Mostly with the checksum put right, as a reader that stops there would see nothing of the damage.
void read_checkpoint(std::string_view bytes) {
  std::string identity;
  if (bytes.starts_with("{\"sha256\"")) {
    design::parse_checkpoint(design::unsealed_state(std::string(bytes)), identity);
  } else {
    design::parse_checkpoint(std::string(bytes), identity);
  }
}

const core::CellGrid kToleranceCells{2, 2, 0.0, 0.0, 1.0, 1.0};

void read_tolerance(std::string_view bytes) {
  const auto run = app::read_tolerance_state(std::string(bytes), "identity", {kToleranceCells, 2, 8});
  for (const design::SampleResult& sample : run.samples) core::expects(sample.parameters.size() == 2, "two of each");
}

std::string tolerance() {
  design::ToleranceSamples run;
  run.reference.assign(design::kFigures.size(), {0.1, 0.01});
  const tracer::LuminanceMap map{core::CellField(kToleranceCells, 100.0), core::CellField(kToleranceCells, 0.5)};
  for (const double place : {0.25, 0.75}) {
    run.samples.push_back({{place, 1.0}, run.reference, {{0.5, 0.5}, {0.25, 0.25}}});
    run.maps.add(map);
  }
  return app::tolerance_state("identity", run);
}

void read_batch(std::string_view bytes) {
  design::batch_html(design::read_batch_json(std::string(bytes)), "nowhere");
}

void read_dots_csv(std::string_view bytes) {
  core::parse_dot_csv(bytes, "dots.csv");
}

void read_dots_dxf(std::string_view bytes) {
  core::parse_dot_dxf(bytes, "dots.dxf");
}

std::vector<std::string> run_files() {
  std::vector<std::string> seeds = {kTinyRun};
  for (const char* name : {"configs/monitor_stack.yaml", "configs/phone_stack.yaml", "configs/monitor_two_edges.yaml",
                           "configs/studies/phone_optimize.yaml"}) {
    seeds.push_back(file_text(source(name)));
  }
  return seeds;
}

/// Few lines of a long table, so that thousands of files can be tried in a minute.
std::string film_csv() {
  const std::string good = file_text(source("tests/app/faulty/tables/good.csv"));
  return good.substr(0, 20000);
}

std::string checkpoint() {
  design::DesignProgress progress;
  design::StepRecord step;
  step.updater = "ratio";
  progress.steps = {step};
  progress.density.cells = {{2, 2, 0.0, 0.0, 1.0, 1.0}, 0.25};
  progress.start_luminance = progress.density.cells;
  progress.best_density = progress.density;
  const TempFolder folder;
  design::save_checkpoint(folder / "checkpoint.json", "identity", progress);
  return file_text(folder / "checkpoint.json");
}

std::string batch() {
  design::BatchTable table;
  table.title = "<b>title";
  design::BatchRow row;
  row.name = "p1";
  row.status = design::BatchStatus::kDone;
  row.changes = {{"trace.seed", "2"}};
  table.rows = {row, design::BatchRow{}};
  return design::batch_json(table);
}

constexpr const char* kReadings =
    "# angles in degrees, wavelength nm, values 1/sr\n"
    "kind,psi_deg,sigma_deg,phi_deg,theta_deg,lambda_nm,b0,b45,b90,b135,se\n"
    "BTDF,0,10,0,5,550,0.1,0.2,0.3,0.2,0.01\nBTDF,0,10,90,5,550,0.1,0.2,0.3,0.2,0.01\n"
    "BRDF,0,10,0,5,550,0.1,0.2,0.3,0.2,0.01\n";
constexpr const char* kGeneralReadings =
    "# angles in degrees, wavelength nm, values 1/sr\n"
    "kind,psi_deg,sigma_deg,phi_deg,theta_deg,lambda_nm,in_kind,in_angle_deg,out_kind,out_angle_deg,value,se\n"
    "BTDF,0,10,0,5,550,linear,0,linear,45,0.1,0.01\nBTDF,0,10,0,5,550,right,,none,,0.2,0.01\n";
constexpr const char* kDxf =
    "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n2\nDOT\n10\n0\n20\n0\n"
    "0\nCIRCLE\n8\n0\n10\n0\n20\n0\n40\n0.05\n0\nENDBLK\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n0\nCIRCLE\n8\n0\n10\n1.0\n"
    "20\n2.0\n40\n0.025\n0\nINSERT\n2\nDOT\n10\n3\n20\n4\n41\n2\n42\n2\n50\n30\n0\nENDSEC\n0\nEOF\n";

Tm25 small_tm25() {
  Tm25 file;
  file.rays = {ray(0, 0, 0, 10, 20, 1), ray(1, 1, 0, 30, 40, 2), ray(0, 1, 0, 50, 60, 3)};
  return file;
}

std::vector<FuzzTarget> make_targets() {
  const std::string state = checkpoint();
  Zemax zemax;
  zemax.rays = small_tm25().rays;
  Ies ies;
  ies.vertical = steps(0, 90, 10);
  Eulumdat eulumdat;
  eulumdat.gammas = steps(0, 180, 10);
  std::vector<FuzzTarget> targets = {
      {"run_file", run_files(), read_run_file},
      {"film_table_csv", {film_csv()}, read_film_table},
      {"stored_table_csv", {film_csv()}, read_stored_csv},
      {"film_table_hdf5", {}, read_hdf5},
      {"readings_csv", {kReadings, kGeneralReadings}, read_readings},
      {"ies", {ies.text(), file_text(source("configs/data/example_led.ies"))}, read_ies},
      {"eulumdat", {eulumdat.text()}, read_eulumdat},
      {"intensity_csv",
       {"theta_deg,phi_deg,intensity_cd\n0,0,1\n10,0,0.9\n90,0,0\n", "angle_deg,intensity\n0,1\n90,0\n"},
       read_intensity},
      {"tm25", {small_tm25().bytes()}, read_tm25},
      {"zemax", {zemax.bytes()}, read_zemax},
      {"checkpoint", {state, design::unsealed_state(state)}, read_checkpoint},
      {"tolerance_state", {tolerance()}, read_tolerance},
      {"batch_json", {batch()}, read_batch},
      {"dots_csv",
       {"# mm\nx_mm,y_mm,diameter_um,angle_deg\n1,2,50,0\n3,4,60,10\n", "y_mm,x_mm,diameter_um\n1,2,50\n"},
       read_dots_csv},
      {"dots_dxf", {kDxf}, read_dots_dxf},
  };
  tracer::StoredTable table;
  try {
    table = tracer::parse_csv_table(file_text(source("tests/app/faulty/tables/good.csv")), "good.csv");
  } catch (const core::Error&) {
    std::abort();  // the seed is part of the tests
  }
  const std::string bytes = tracer::hdf5_table_bytes(table);
  // As other programs write them: without the user block whose checksum would end the reading at once.
  targets[3].seeds = {bytes, bytes.substr(512)};
  return targets;
}

}  // namespace

const std::vector<FuzzTarget>& fuzz_targets() {
  static const std::vector<FuzzTarget> targets = make_targets();
  return targets;
}

}  // namespace evenglow::tests
