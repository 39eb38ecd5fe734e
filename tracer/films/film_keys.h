#pragma once

#include <string>
#include <string_view>

#include "core/config/config_node.h"
#include "tracer/films/film.h"

/// Keys that several kinds of films share.
namespace evenglow::tracer {

/// A film with its kind and its `gap_mm`.
Film film_of(std::string kind, const core::ConfigNode& node);

/// `axis_deg` in [0, 180) as rad; `help` says which axis it is.
double axis_of(const core::ConfigNode& node, std::string_view help = "pass axis, counted from +x towards +y");

/// A number in [0, 1].
double share(const core::ConfigNode& node, std::string_view key, std::string_view help, double fallback);

/// Notes a fault at `part_key` and lowers `part` if the two come to more than the whole.
void require_sum(const core::ConfigNode& node, double whole, std::string_view whole_key, double& part,
                 std::string_view part_key);

}  // namespace evenglow::tracer
