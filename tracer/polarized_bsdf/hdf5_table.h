#pragma once

#include <string>
#include <string_view>

#include "tracer/polarized_bsdf/stored_table.h"

namespace evenglow::tracer {

/// Film tables in HDF5; the layout is that of docs/films.md.
///
/// | root attribute | |
/// | --- | --- |
/// | format, version | `evenglow-film-table`, 1 |
/// | form | `diattenuator` or `mueller` |
/// | kind | what the first index of the values counts: `BRDF,BTDF`, `BRDF` or `BTDF` |
/// | comment | free text, optional |
///
/// Datasets in the root group: the axes `psi`, `sigma`, `phi`, `theta` (unit `deg`) and `lambda` (`nm`), ascending; the
/// values under the names of the CSV columns less the ending `_deg`, of shape [kind, psi, sigma, phi, theta, lambda].
/// Each has the attribute `unit`: `deg`, `nm`, `1/sr` or `1`. Before all that a user block of 512 bytes with the
/// SHA-256 of the rest, which files of other programs need not have.

/// Throws `core::ConfigError`, one line for each fault with the dataset's name: no HDF5 file, cut short, damaged,
/// another format or version, a dataset missing or unknown (told by their number alone), of a wrong shape, type, unit
/// or size (32 million numbers in all), an axis that does not ascend, a number out of its range.
StoredTable parse_hdf5_table(std::string_view bytes, const std::string& name);

std::string hdf5_table_bytes(const StoredTable& table);

}  // namespace evenglow::tracer
