#include <algorithm>
#include <fstream>
#include <regex>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/app/tiny_run.h"

/// Run files as hasty people write them. Each is refused before anything is made: exit code 2, each fault in one line
/// on stderr with its place, nothing on stdout.
namespace evenglow::tests {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr double kPatience_s = 20;  // a sanitized build is many times slower
#else
constexpr double kPatience_s = 2;
#endif

/// The commands that must refuse a file.
enum Commands { kEvery, kOfDesigns, kOfVariants, kCompare };

struct FaultyFile {
  std::string name;   ///< of the file, without `.yaml`
  std::string fault;  ///< how one of the lines goes on after the name of the file
  Commands commands = kEvery;
};

const FaultyFile kFiles[] = {
    // clang-format off
    {"alias_bomb", ":13:10: must not hold more than 200000 values, aliases"},
    {"alias_to_itself", ":8:12: an alias must not stand inside the value that it names"},
    {"angle_out_of_range", ":6:52: backlight.films[1].axis_deg: must lie in [0, 180), got 270"},
    {"backlight_empty", ":2:1: backlight: must be a map, got nothing"},
    {"backlight_list", ":2:12: backlight: must be a map, got a list"},
    {"backlight_missing", ":1:1: backlight: must be given"},
    {"batches_beyond_memory", ":8:32: trace.batches: must be at most 400 where the display has 1000 x 1000 cells"},
    {"batches_one", ":7:32: trace.batches: must lie in [10, 1000], got 1"},
    {"binary", ":1:1: must be UTF-8 text, got the byte 0x89"},
    {"bilinear_with_gradient", ":8:19: design.updater: must be another one where the density is bilinear within a cell, got gradient"},
    {"cells_fraction", ":4:28: backlight.microstructure.cells[0]: must be a whole number, got 8.5"},
    {"cells_huge", ":4:28: backlight.microstructure.cells[0]: must lie in [1, 4096], got 1e9"},
    {"cells_number", ":4:27: backlight.microstructure.cells: must be a list of numbers, got 8"},
    {"cells_one", ":4:27: backlight.microstructure.cells: must hold 2 numbers, got 1"},
    {"cells_too_many", ":4:27: backlight.microstructure.cells: must not be more than 1000000 cells in all, got 16000000"},
    {"cells_zero", ":4:28: backlight.microstructure.cells[0]: must lie in [1, 4096], got 0"},
    {"color_bound_without_receiver", ":8:30: design.subject_to.color: needs a receiver of kind color in backlight.receivers, got none"},
    {"comment_only", ": must hold a map of keys, got an empty file"},
    {"cone_zero", ":7:43: backlight.receivers[0].cone_deg: must be at least 0.5 where photons are counted, got 0"},
    {"dbef_energy", ":6:85: backlight.films[1].reflectance_pass: must be at most 1 - transmittance_pass = 0.1, got 0.2"},
    {"decimal_comma", ":3:66: backlight.light_guide_plate.thickness_mm: must be a number without quotes, got \"0,6\""},
    {"deep_nesting", ":8:71: must not nest deeper than 64"},
    {"density_limits_above_one", ":8:26: design.density[1]: must lie in [0, 1], got 80"},
    {"density_limits_one", ":8:19: design.density: must be a list of numbers, got 0.5"},
    {"density_limits_swapped", ":8:19: design.density: must be two numbers, 0 < least < largest, got [0.8, 0.01]"},
    {"density_limits_zero", ":8:19: design.density: must be two numbers, 0 < least < largest, got [0, 0.8]"},
    {"diffuser_energy", ":6:61: backlight.films[0].reflectance: must be at most 1 - transmittance = 0.1, got 0.2"},
    {"duplicate_key", ":3:71: backlight.light_guide_plate.length_mm: a key must not be given twice, first in line 3"},
    {"duplicate_top_key", ":8:1: trace: a key must not be given twice, first in line 7"},
    {"edge_bottom", ":5:35: backlight.sources[0].edge: must be one of"},
    {"edge_unknown", ":5:35: backlight.sources[0].edge: must be one of"},
    {"empty", ": must hold a map of keys, got an empty file"},
    {"exponent_without_pattern", ":5:39: backlight.sources[0].exponent: unknown key, known here"},
    {"face_misspelled", ":4:26: backlight.microstructure.face: must be one of"},
    {"film_key_of_another_kind", ":6:41: backlight.films[1].haze: unknown key, known here"},
    {"fraction_for_count", ":5:36: backlight.sources[0].count: must be a whole number, got 2.5"},
    {"gap_zero", ":6:49: backlight.films[1].gap_mm: must lie in [0.001, 100], got 0"},
    {"hemispherical_angle", ":6:81: backlight.films[1].hemispherical: tables/hemispherical_angle.csv:2:1: sigma_deg: must be a number in [0, 90], got '95'"},
    {"hemispherical_angle_twice", ":6:81: backlight.films[1].hemispherical: tables/hemispherical_angle_twice.csv:3:1: sigma_deg: must hold each angle once, got 0 again (first on line 2)"},
    {"hemispherical_energy", ":6:81: backlight.films[1].hemispherical: tables/hemispherical_energy.csv:2:8: reflectance_pass: must be at most 1 - transmittance_pass = 0.12, got 0.2"},
    {"hemispherical_missing", ":6:81: backlight.films[1].hemispherical: must be an existing file, found none at tables/none.csv"},
    {"hemispherical_percent", ":6:81: backlight.films[1].hemispherical: tables/hemispherical_percent.csv:2:3: transmittance_pass: must be a number in [0, 1], got '88'"},
    {"hemispherical_without_table", ":6:57: backlight.films[1].hemispherical: must stand beside the table that it normalizes, got no table"},
    {"hexadecimal", ":3:66: backlight.light_guide_plate.thickness_mm: must be a decimal number, got 0x1p-1"},
    {"huge_size", ":3:34: backlight.light_guide_plate.length_mm: must lie in [0.1, 10000], got 1e300"},
    {"index_below_one", ":6:61: backlight.films[1].refractive_index: must lie in [1.0001, 4], got 0.9"},
    {"infinity", ":3:34: backlight.light_guide_plate.length_mm: must be a finite number, got .inf"},
    {"key_is_list", ":8:1: a key must be a word, got a list"},
    {"key_is_map", ":8:3: a key must be a word, got a map"},
    {"led_behind_reflector", ":5:60: backlight.sources[0].gap_mm: must not be larger than that of the left reflector (0.05 mm), got 0.2 mm: the light would start behind it"},
    {"led_higher_than_plate", ":5:61: backlight.sources[0].size_mm: the LED must not be higher than the plate (0.6 mm), got 0.8 mm"},
    {"led_row_without_plate", ":3:13: backlight.sources[0]: an led_row needs a light_guide_plate to stand at, got none"},
    {"led_size_one_number", ":5:48: backlight.sources[0].size_mm: must be a list of numbers, got 2.6"},
    {"led_wider_than_edge", ":5:48: backlight.sources[0].size_mm: the LED must not be wider than the left edge (10 mm), got 12 mm"},
    {"leds_in_one_place", ":5:53: backlight.sources[1]: its LEDs must not stand where those of sources[0] are, got both at 2.25 mm along the left edge"},
    {"leds_overlap", ":5:49: backlight.sources[0].pitch_mm: the pitch must not be less than the LED's width (2.6 mm), got 2 mm"},
    {"level_outside_limits", ":8:17: design.level: must lie between the limits of the density, [0.01, 0.8], got 0.9"},
    {"list_for_number", ":3:66: backlight.light_guide_plate.thickness_mm: must be a number, got a list"},
    {"lpp_energy", ":6:63: backlight.films[1].reflectance: must be at most 1 - k1 = 0.1, got 0.2"},
    {"lpp_k2_above_k1", ":6:54: backlight.films[1].k2: must be at most k1 = 0.4, got 0.5"},
    {"map_for_list", ":6:10: backlight.films: must be a list of maps, got a map"},
    {"map_for_number", ":3:66: backlight.light_guide_plate.thickness_mm: must be a number, got a map"},
    {"margin_negative", ":7:52: backlight.receivers[0].margins.left_mm: must lie in [0, 1000], got -1"},
    {"margins_leave_nothing", ":7:42: backlight.receivers[0].margins: must leave an active area, got 0 mm x 10 mm"},
    {"material_and_index", ":3:81: backlight.light_guide_plate.material: must be left out where refractive_index is given, got both"},
    {"material_unknown", ":3:81: backlight.light_guide_plate.material: must be one of"},
    {"max_steps_negative", ":8:21: design.max_steps: must lie in [0, 1000], got -1"},
    {"merge_key", ":7:15: backlight.receivers[0].kind: must be given"},
    {"microstructure_missing", ":3:3: backlight.microstructure: must be given", kOfDesigns},
    {"microstructure_without_plate", ":3:19: backlight.microstructure: needs a light_guide_plate to stand on, got none"},
    {"missing_film_kind", ":6:29: backlight.films[1].kind: must be given"},
    {"missing_unit", ":3:52: backlight.light_guide_plate.thickness: unknown key, the unit must be mm: `thickness_mm`"},
    {"nan", ":3:34: backlight.light_guide_plate.length_mm: must be a finite number, got .nan"},
    {"negative_size", ":3:34: backlight.light_guide_plate.length_mm: must lie in [0.1, 10000], got -20"},
    {"next_event_under_a_reflector", ":8:44: backlight.receivers[0].estimator: next_event needs something that scatters (a diffuser, a dbef with a table, printed dots, a white bottom), and above it neither a sheet that scatters in its bulk nor a reflector at the top"},
    {"next_event_without_scatterer", ":7:44: backlight.receivers[0].estimator: next_event needs something that scatters (a diffuser, a dbef with a table, printed dots, a white bottom), and above it neither a sheet that scatters in its bulk nor a reflector at the top"},
    {"no_luminance_bins", ":7:44: backlight.receivers[0].polar_count: must lie in [1, 180], got 0"},
    {"not_a_map", ":1:1: must hold a map of keys (`key: value`), got a list"},
    {"not_yaml", ":2:12: not valid YAML: illegal map value"},
    {"nothing_for_number", ":3:52: backlight.light_guide_plate.thickness_mm: must be a number, got nothing"},
    {"number_for_map", ":3:22: backlight.light_guide_plate: must be a map, got 0.6"},
    {"number_with_unit", ":3:66: backlight.light_guide_plate.thickness_mm: must be a number, got 0.6 mm"},
    {"output_empty", ":8:9: output: must name at least one format, got none"},
    {"output_twice", ":8:16: output[1]: must not be given twice, got json"},
    {"output_unknown", ":8:16: output[1]: must be one of"},
    {"output_word", ":8:9: output: must be a list of words, got json csv"},
    {"photons_fraction", ":7:18: trace.photons: must be a whole number (20e6 is one too), got 1.5"},
    {"photons_huge", ":7:18: trace.photons: must be a whole number of at most 18 digits, got 1e30"},
    {"photons_list", ":7:18: trace.photons: must be a whole number (20e6 is one too), got a list"},
    {"photons_negative", ":7:18: trace.photons: must lie in [1000, 1000000000000], got -1"},
    {"photons_text", ":7:18: trace.photons: must be a whole number (20e6 is one too), got many"},
    {"photons_zero", ":7:18: trace.photons: must lie in [1000, 1000000000000], got 0"},
    {"plate_and_size", ":6:9: backlight.size: must be left out where there is a light_guide_plate, whose length and width count"},
    {"quoted_number", ":3:66: backlight.light_guide_plate.thickness_mm: must be a number without quotes, got \"0.6\""},
    {"reflectance_percent", ":6:51: backlight.reflectors.bottom.reflectance: must lie in [0, 1], got 96"},
    {"reflector_kind", ":6:31: backlight.reflectors.bottom.kind: must be one of"},
    {"reflector_side", ":6:16: backlight.reflectors.below: unknown key, known here"},
    {"row_longer_than_edge", ":5:49: backlight.sources[0].pitch_mm: the row of 3 LEDs must not be longer than the left edge (10 mm), got 11.6 mm"},
    {"seed_fraction", ":7:29: trace.seed: must be a whole number, got 1.5"},
    {"seed_negative", ":7:29: trace.seed: must be at least 0, got -1"},
    {"several_faults", ":3:34: backlight.light_guide_plate.length_mm: must lie in [0.1, 10000], got -20"},
    {"single_variant", ": variants: compare needs at least two variants, or several files, got one", kCompare},
    {"sources_empty", ":5:12: backlight.sources: must list at least one source, got none"},
    {"sources_missing", ":3:3: backlight.sources: must list at least one source, got none"},
    {"start_density_above_one", ":4:44: backlight.microstructure.density: must lie in [0, 1], got 10"},
    {"stop_rms_percent", ":8:20: design.stop_rms: must be a number, got 1 %"},
    {"stop_rms_zero", ":8:20: design.stop_rms: must lie in (0, 1], got 0"},
    {"subcells_of_constant", ":4:45: backlight.microstructure.subcells: belongs to interpolation bilinear, got it with constant"},
    {"table_angle_out_of_range", ":6:49: backlight.films[1].table: tables/angle_out_of_range.csv:34:16: theta_deg: must be a number in [0, 180), got '200'"},
    {"table_binary", ":6:49: backlight.films[1].table: tables/binary.csv:1:1: columns must be"},
    {"table_directory", ":6:49: backlight.films[1].table: must be a file, got the directory tables"},
    {"table_empty", ":6:49: backlight.films[1].table: tables/empty.csv: must be a CSV table, got an empty file"},
    {"table_gain", ":6:49: backlight.films[1].table: tables/gain.csv: must give R + T of at most 1.05 for any polarization (or stand beside hemispherical), got 4.918 at psi 0 sigma 0 lambda 550"},
    {"table_header_only", ":6:49: backlight.films[1].table: tables/header_only.csv: must hold at least one row of numbers, got none"},
    {"table_infinity", ":6:49: backlight.films[1].table: tables/infinity.csv:31:24: tau_max: must be a number in [0, 1e12], got 'inf'"},
    {"table_missing", ":6:49: backlight.films[1].table: must be an existing file, found none at tables/none.csv"},
    {"table_missing_column", ":6:49: backlight.films[1].table: tables/missing_column.csv:1:1: delta_deg: is a required column, got a header without it"},
    {"table_nan", ":6:49: backlight.films[1].table: tables/nan.csv:8:20: tau_min: must be a number in [0, 1e12], got 'nan'"},
    {"table_negative", ":6:49: backlight.films[1].table: tables/negative.csv:31:20: tau_min: must be a number in [0, 1e12], got '-0.2'"},
    {"table_no_header", ":6:49: backlight.films[1].table: tables/no_header.csv:1:1: columns must be"},
    {"table_no_name", ":6:49: backlight.films[1].table: must be the name of a file, got \"\""},
    {"table_radians", ":6:49: backlight.films[1].table: tables/radians.csv:1:1: the comment must name the units degrees, nm and 1/sr, got 'radians'"},
    {"table_repeated_node", ":6:49: backlight.films[1].table: tables/repeated_node.csv: must hold every node of its grid, got none for BTDF psi 90 sigma 45 phi 0 theta 0 lambda 550"},
    {"table_row_missing", ":6:49: backlight.films[1].table: tables/row_missing.csv: must hold every node of its grid, got none for BRDF psi 90 sigma 0 phi 0 theta 30 lambda 550"},
    {"table_semicolons", ":6:49: backlight.films[1].table: tables/semicolons.csv:2:1: columns must be"},
    {"table_short_row", ":6:49: backlight.films[1].table: tables/short_row.csv:31:1: must have 9 entries as the header (line 2), got 7"},
    {"table_swapped", ":6:49: backlight.films[1].table: tables/swapped.csv:31:20: tau_min: must be at most tau_max = 0.2, got 2"},
    {"table_text", ":6:49: backlight.films[1].table: tables/text.csv:8:20: tau_min: must be a number in [0, 1e12], got 'n/a'"},
    {"table_truncated", ":6:49: backlight.films[1].table: tables/truncated.csv: must hold every node of its grid, got none for BTDF psi 0 sigma 45 phi 0 theta 0 lambda 550"},
    {"table_unknown_column", ":6:49: backlight.films[1].table: tables/unknown_column.csv:2:52: columns must be"},
    {"table_zero", ":6:49: backlight.films[1].table: tables/zero.csv: must reflect or transmit, got tau 0 everywhere"},
    {"tabs", ":3:19: not valid YAML: illegal map value (lines must be indented with spaces, not tabs)"},
    {"tag", ":3:34: backlight.light_guide_plate.length_mm: tags are not allowed, got tag:yaml.org,2002:int"},
    {"text_for_number", ":3:66: backlight.light_guide_plate.thickness_mm: must be a number, got thin"},
    {"title_list", ":8:8: title: must be text, got a list"},
    {"too_many_leds_by_default", ":5:13: backlight.sources[0].count: 12 LEDs of 2.6 mm must not be longer side by side than the left edge (10 mm), got 31.2 mm"},
    {"two_angular_receivers", ":7:32: backlight.receivers[1]: there must be one angular receiver at most, got another"},
    {"two_documents", ":8:1: must hold one YAML document, got a second one"},
    {"two_luminance_receivers", ":7:34: backlight.receivers[1]: there must be one luminance receiver at most, got another"},
    {"unclosed_bracket", ":4:32: not valid YAML: illegal flow end"},
    {"unclosed_quote", ":1:8: not valid YAML: the quote that opens here is never closed"},
    {"unknown_alias", ":8:8: not valid YAML: the referenced anchor is not defined"},
    {"unknown_film", ":6:36: backlight.films[1].kind: must be one of"},
    {"unknown_key", ":3:52: backlight.light_guide_plate.thicknes_mm: unknown key, did you mean `thickness_mm`?"},
    {"unknown_key_top", ":8:1: desing: unknown key, did you mean `design`?"},
    {"unknown_microstructure", ":4:26: backlight.microstructure.kind: must be one of"},
    {"unknown_receiver", ":7:22: backlight.receivers[0].kind: must be one of"},
    {"unknown_source", ":5:20: backlight.sources[0].kind: must be one of"},
    {"view_without_direction", ":7:41: backlight.receivers[0].views[0].direction_deg: must be given"},
    {"views_beside_direction", ":7:48: backlight.receivers[0].direction_deg: must be left out beside views, got both"},
    {"unknown_updater", ":8:19: design.updater: must be one of"},
    {"utf16", ":1:1: must be UTF-8 text, got the byte 0xff"},
    {"variant_bad_name", ":9:11: variants.../lpp: a variant's name must be of letters, digits, _, - and ., not begin with . and have at most 100 of them"},
    {"variant_bad_path", ":9:9: backlight..films: must be a key path such as trace.photons or backlight.films[1].axis_deg", kOfVariants},
    {"variant_film_outside_stack", ":9:9: backlight.films: holds 2 items, the index must lie in [0, 2], got 7", kOfVariants},
    {"variant_in_variant", ":9:9: variants: variants cannot be overridden", kOfVariants},
    {"variant_list", ":9:8: variants.lpp: must be a map of key paths ({} for no change), got a list"},
    {"variant_named_as_a_result", ": variants.report.html: must not have the name of a result file, got report.html", kOfVariants},
    {"variant_no_map", ":9:3: variants.lpp: must be a map of key paths ({} for no change), got nothing"},
    {"variant_twice", ":10:3: variants.lpp: a key must not be given twice, first in line 9"},
    {"variant_unknown_key", ":9:9: backlight.film: unknown key, did you mean `films`?", kOfVariants},
    {"variant_unquoted_path", ":9:24: not valid YAML: end of map flow not found (within { } a key or text that holds [ ] { } or , must be quoted)"},
    {"variant_wrong_value", ":9:47: backlight.films[1].k1: must lie in [0, 1], got 2", kOfVariants},
    {"variants_list", ":9:3: variants: must be a map, got a list"},
    {"version_2", ":1:11: evenglow: must be 1, the version of the format that this program reads, got 2"},
    {"version_missing", ":1:1: evenglow: must be given"},
    {"version_text", ":1:11: evenglow: must be a whole number, got one"},
    {"word_for_count", ":5:36: backlight.sources[0].count: must be a whole number, got two"},
    {"word_in_list", ":6:11: backlight.films[0]: must be a map, got diffuser"},
    {"wrong_unit", ":3:52: backlight.light_guide_plate.thickness_cm: unknown key, the unit must be mm: `thickness_mm`"},
    {"zero_count", ":5:36: backlight.sources[0].count: must lie in [1, 10000], got 0"},
    {"zero_flux", ":5:48: backlight.sources[0].flux_lm: must lie in (0, 1000000], got 0"},
    {"zero_size", ":3:48: backlight.light_guide_plate.width_mm: must lie in [0.1, 10000], got 0"},
    {"fluxes_count", ":5:63: backlight.sources[0].fluxes_lm: must hold a flux for each of the 2 LEDs, got 1"},
    {"half_angle_and_exponent", ":5:81: backlight.sources[0].half_angle_deg: must be left out where the exponent is given"},
    {"leds_all_off", ":5:57: backlight.sources[0].off: must leave an LED on"},
    {"pattern_behind", ":5:86: backlight.sources[0].pattern_file: must hold light within 90 degrees"},
    {"pattern_file_missing", ":5:13: backlight.sources[0].pattern_file: must be given"},
    {"pattern_file_of_another_kind", ":5:85: backlight.sources[0].pattern_file: tables/led_tilt.ies:2:1: type indicator Ityp (line 2): must be a number"},
    {"pattern_tilt", ":5:80: backlight.sources[0].pattern_file: tables/led_tilt.ies:7:1: TILT: must be NONE or INCLUDE"},
    {"pattern_truncated", ":5:80: backlight.sources[0].pattern_file: tables/led_truncated.ies:21:1: must go on with the intensity"},
    {"position_spread", ":5:72: backlight.sources[0].position_spread_mm: must be at most 0.06667 mm"},
    {"ray_file_axis", ":5:68: backlight.sources[0].axis: must be one of"},
    {"ray_file_missing", ":5:36: backlight.sources[0].file: must be an existing file"},
    {"ray_file_negative_flux", ":5:36: backlight.sources[0].file: tables/rays_negative.dat: ray 2: flux: must not be negative, got -1"},
    {"ray_file_text", ":5:36: backlight.sources[0].file: tables/good.csv: must be a TM-25 or Zemax ray file"},
    {"ray_file_truncated", ":5:36: backlight.sources[0].file: tables/rays_truncated.dat: must hold 2 rays of 28 bytes from byte 208 to its end, got 48"},
    {"cone_flank_and_aspect", ":4:70: backlight.microstructure.aspect: must be left out where flank_deg is given, got both"},
    {"cone_too_steep", ":4:55: backlight.microstructure.aspect: must not make flanks steeper than 85 deg, got 86.4237 deg with the truncation 0.5"},
    {"dot_energy", ":4:50: backlight.microstructure.transmittance: must not exceed 0.05 with the reflectance 0.95, got 0.2"},
    {"groove_one_flank", ":4:63: backlight.microstructure.flanks_deg: must hold 2 numbers, got 1"},
    {"microlens_aspect", ":4:60: backlight.microstructure.aspect: must lie in [0.0001, 0.5], got 0.6"},
    {"microlens_axis", ":4:52: backlight.microstructure.axis_deg: unknown key"},
    {"microlens_fill", ":4:58: backlight.microstructure.fill: must lie in [0.01, 0.785] or be 1 for a round footprint, got 0.9"},
    {"pyramid_form", ":4:56: backlight.microstructure.form: must be one of raised, sunk; got flat"},
    {"diffuser_abg_width", ":6:46: backlight.films[0].abg_b: must make abg_b^(1/abg_g), the half width in direction cosines, lie in [0.001, 2], got 3.16228e-05"},
    {"diffuser_abg_without_b", ":6:11: backlight.films[0].abg_b: must be given"},
    {"diffuser_haze_above_share", ":6:50: backlight.films[0].haze_astm: must be at most 0.3991, what lobes of 1 to 150 degrees can give where the share haze = 0.4 is scattered, got 0.5"},
    {"diffuser_haze_and_width", ":6:39: backlight.films[0].haze_astm: must be left out where fwhm_deg is given, got both"},
    {"diffuser_haze_percent", ":6:39: backlight.films[0].haze_astm: must lie in (0, 1), got 85"},
    {"diffuser_table_gap", ":6:52: backlight.films[0].table: tables/scatter_gap.csv: must be a full grid, got no row for incidence_deg 45, theta_deg 20"},
    {"diffuser_table_haze", ":6:77: backlight.films[0].haze: unknown key"},
    {"diffuser_table_missing", ":6:11: backlight.films[0].table: must be given"},
    {"diffuser_table_negative", ":6:52: backlight.films[0].table: tables/scatter_negative.csv:3:6: btdf: must be a number of at least 0, got '-0.4'"},
    {"diffuser_table_total", ":6:110: backlight.films[0].reflectance: must be 0 for a table without brdf, got 0.1"},
    {"sheet_anisotropy", ":6:59: backlight.films[0].anisotropy: must lie in [-0.99, 0.999], got 1"},
    {"sheet_anisotropy_of_a_clear_one", ":6:37: backlight.films[0].anisotropy: must stand beside scattering_per_mm above 0, got a sheet that is clear"},
    {"sheet_material_and_index", ":6:35: backlight.films[0].material: must be left out where refractive_index is given, got both"},
    {"sheet_scattering_negative", ":6:44: backlight.films[0].scattering_per_mm: must lie in [0, 10000], got -5"},
    {"sheet_too_thick", ":6:44: backlight.films[0].scattering_per_mm: must be at most 500 for this thickness (1000 mean free paths), got 2000"},
    // clang-format on
};

std::filesystem::path faulty_folder() {
  return std::filesystem::path(EVENGLOW_SOURCE_DIR) / "tests" / "app" / "faulty";
}

std::vector<std::string> refusing(Commands commands) {
  switch (commands) {
    case kOfDesigns:
      return {"design", "compare"};
    case kOfVariants:
      return {"check", "compare"};
    case kCompare:
      return {"compare"};
    default:
      return {"check", "simulate", "design", "compare"};
  }
}

/// Runs the command on the file and expects all that holds for any faulty file; returns the lines.
std::vector<std::string> refusal(const std::string& command, const std::string& file,
                                 const std::filesystem::path& folder) {
  const TempFolder place;
  const auto out = place / "out";
  std::vector<std::string> words = {command, file};
  if (command != "check") words.insert(words.end(), {"-o", out.string()});
  const ProgramResult result = evenglow(words, folder);
  EXPECT_EQ(result.code, 2) << command << ": " << result.err;
  EXPECT_THAT(result.out, IsEmpty()) << command;
  EXPECT_FALSE(std::filesystem::exists(out)) << command;
  EXPECT_LT(result.cpu_s, kPatience_s) << command;
  const std::vector<std::string> lines = result.err_lines();
  EXPECT_FALSE(lines.empty()) << command;
  static const std::regex kPlaceAndMessage("(:[0-9]+(:[0-9]+)?)?: [^ ].*");
  for (const std::string& line : lines) {
    EXPECT_THAT(line, StartsWith(file)) << command;
    EXPECT_TRUE(std::regex_match(line.substr(std::min(file.size(), line.size())), kPlaceAndMessage)) << line;
  }
  return lines;
}

class FaultyRunFile : public ::testing::TestWithParam<FaultyFile> {};

TEST_P(FaultyRunFile, IsRefusedWithThePlaceAndTheReason) {
  const std::string file = GetParam().name + ".yaml";
  for (const std::string& command : refusing(GetParam().commands)) {
    EXPECT_THAT(refusal(command, file, faulty_folder()), Contains(StartsWith(file + GetParam().fault))) << command;
  }
}

INSTANTIATE_TEST_SUITE_P(Corpus, FaultyRunFile, ::testing::ValuesIn(kFiles),
                         [](const ::testing::TestParamInfo<FaultyFile>& file) { return file.param.name; });

TEST(FaultyRunFiles, EachFileOfTheFolderIsTested) {
  std::set<std::string> in_folder;
  for (const auto& entry : std::filesystem::directory_iterator(faulty_folder())) {
    if (entry.path().extension() == ".yaml") in_folder.insert(entry.path().stem().string());
  }
  std::set<std::string> in_table;
  for (const FaultyFile& file : kFiles) in_table.insert(file.name);
  EXPECT_EQ(in_folder, in_table);
}

TEST(FaultyRunFiles, TheyAreFaultyInOneThingOnly) {
  const TempFolder folder;
  write_text(folder / "tiny.yaml", kTinyRun);
  EXPECT_EQ(evenglow({"check", "tiny.yaml"}, folder.path()).code, 0);
  const ProgramResult table = evenglow({"check", "table_missing.yaml", "--set",
                                        "backlight.films[1]={kind: dbef, table: tables/good.csv, "
                                        "hemispherical: tables/hemispherical_good.csv}"},
                                       faulty_folder());
  EXPECT_EQ(table.code, 0) << table.err;
}

TEST(FaultyRunFiles, AllFaultsOfAFileAreToldAtOnce) {
  const auto lines = refusal("check", "several_faults.yaml", faulty_folder());
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_THAT(lines[0], HasSubstr("several_faults.yaml:3:34: backlight.light_guide_plate.length_mm: "));
  EXPECT_THAT(lines[1], HasSubstr("several_faults.yaml:6:36: backlight.films[1].kind: "));
  EXPECT_THAT(lines[2], HasSubstr("several_faults.yaml:7:18: trace.photons: "));
  EXPECT_THAT(lines[3], HasSubstr("several_faults.yaml:8:1: desing: "));
}

TEST(FaultyRunFiles, CheckTellsTheFaultsOfAllFiles) {
  const ProgramResult result = evenglow({"check", "nan.yaml", "several_faults.yaml", "empty.yaml"}, faulty_folder());
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(result.err_lines().size(), 6u) << result.err;
}

// ---------------------------------------------------------------- what cannot be kept as a file

TEST(FaultyRunFiles, AHundredMegabytesAreRefusedUnread) {
  const TempFolder folder;
  write_text(folder / "large.yaml", kTinyRun);
  std::filesystem::resize_file(folder / "large.yaml", 100u << 20);
  for (const std::string& command : refusing(kEvery)) {
    EXPECT_THAT(refusal(command, "large.yaml", folder.path()),
                Contains(StartsWith("large.yaml: must not be larger than 8 MiB, got 100.0 MiB")));
  }
}

TEST(FaultyRunFiles, DirectoriesAndMissingFilesAreRefused) {
  const TempFolder folder;
  std::filesystem::create_directory(folder / "folder.yaml");
  for (const std::string& command : refusing(kEvery)) {
    EXPECT_THAT(refusal(command, "folder.yaml", folder.path()),
                Contains("folder.yaml: must be a file, got a directory"));
    EXPECT_THAT(refusal(command, "none.yaml", folder.path()),
                Contains("none.yaml: cannot be opened: No such file or directory"));
  }
}

TEST(FaultyRunFiles, PipesAreRefusedWithoutWaiting) {
  const TempFolder folder;
  ASSERT_EQ(::mkfifo((folder / "pipe.yaml").c_str(), 0600), 0);
  EXPECT_THAT(refusal("design", "pipe.yaml", folder.path()), Contains(StartsWith("pipe.yaml: must be a regular file")));
}

TEST(FaultyRunFiles, UnreadableFilesAreRefused) {
  const TempFolder folder;
  write_text(folder / "locked.yaml", kTinyRun);
  std::filesystem::permissions(folder / "locked.yaml", std::filesystem::perms::none);
  EXPECT_THAT(refusal("design", "locked.yaml", folder.path()),
              Contains("locked.yaml: cannot be opened: Permission denied"));
}

}  // namespace
}  // namespace evenglow::tests
