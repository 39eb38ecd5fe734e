#pragma once

#include <memory>
#include <string>

#include "core/base/error.h"
#include "core/config/config_node.h"
#include "tracer/microstructure/microstructure.h"

namespace evenglow::tests {

/// The shape of a run file: `kind: cone, form: sunk, flank_deg: 40`. Throws `core::ConfigError` for every fault.
inline tracer::Microstructure shape_of(const std::string& keys) {
  const core::ConfigDocument document = core::ConfigDocument::parse("microstructure: {" + keys + "}\n", "run.yaml");
  const core::ConfigNode node = document.root().map("microstructure", "a pattern", true);
  auto shape = tracer::microstructure_registry().make(node);
  document.finish();
  return std::move(shape.value());
}

/// Its optics on a plate of this index.
inline std::unique_ptr<const tracer::Bsdf> optics_of(const std::string& keys, double index) {
  return shape_of(keys).optics(index);
}

/// The message of the fault that reading these keys ends with; "accepted" if there is none.
inline std::string faults_of_shape(const std::string& keys) {
  try {
    shape_of(keys);
  } catch (const core::ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace evenglow::tests
