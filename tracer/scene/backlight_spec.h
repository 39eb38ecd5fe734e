#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/units.h"
#include "core/config/config_node.h"
#include "core/math/cell_field.h"
#include "tracer/films/film.h"
#include "tracer/films/reflector.h"
#include "tracer/geometry/mesh.h"
#include "tracer/microstructure/microstructure.h"
#include "tracer/optics/material.h"
#include "tracer/receivers/luminance_receiver.h"
#include "tracer/sources/source.h"
#include "tracer/sources/spectrum.h"

namespace evenglow::tracer {

class DotGrid;

/// Serrations of end faces.
struct EntranceTexture {
  std::vector<Side> sides;
  /// Optics at a refractive index of the plate; `axis` (rad): direction of the ridges in the frame of the surface.
  std::function<std::unique_ptr<const Bsdf>(double, double)> optics;
};

struct LightGuidePlateSpec {
  double length = 140.0;                     ///< mm, along x
  double width = 66.0;                       ///< mm, along y
  double thickness = 0.6;                    ///< mm, at the left edge
  double end_thickness = 0.6;                ///< mm, at the right edge; smaller: a wedge whose bottom rises
  std::function<Material(double)> material;  ///< at a wavelength (nm)
  std::optional<EntranceTexture> entrance;
};

struct MicrostructureSpec {
  Side face = Side::kBottom;  ///< bottom or top
  int nx = 96;
  int ny = 48;
  double density = 0.1;             ///< at the start, every cell
  std::vector<double> density_map;  ///< at the start, index iy * nx + ix; empty: `density` everywhere
  int subcells = 1;  ///< parts of a cell along x and y, between which the density runs linearly; 1: constant
  std::shared_ptr<const DotGrid> dots;  ///< the pattern itself, dot by dot; null: by its density
  Microstructure shape;
};

/// The pupil of an eye or a camera that looks at the display: a disk parallel to it, mm.
struct PupilSpec {
  double distance = 0.0;  ///< of its center from the top of the backlight
  double diameter = 0.0;
  double x = 0.0, y = 0.0;  ///< of its center
};

struct LuminanceReceiverSpec {
  core::CellGrid cells;                   ///< active area, mm
  double cone = 10.0 * core::kRadPerDeg;  ///< half angle, rad
  double polar = 0.0;                     ///< of the cone's axis from the normal, rad
  double azimuth = 0.0;                   ///< of the cone's axis from +x towards +y, rad
  std::vector<ViewDirection> views;       ///< several axes instead, whose weighted sum counts; empty: that one
  std::optional<PupilSpec> pupil;         ///< then neither cone nor its axis counts
  LuminanceEstimator estimator = LuminanceEstimator::kNextEvent;
  double least_lobe = 0.0;  ///< rad; what scatters over less is counted (`spreads_over`)
};

struct AngularReceiverSpec {
  int polar_count = 18;
  int azimuth_count = 24;
  int spots = 0;             ///< 0, or those of 1, 9 or 13 points of the active area
  double spot_radius = 0.0;  ///< mm
};

/// A backlight as described: plain values, validated, in mm, rad and lm.
struct BacklightSpec {
  Box area;  ///< the plate, or, without one, the film area from z = 0 to the first film's place
  std::optional<LightGuidePlateSpec> plate;
  std::optional<MicrostructureSpec> microstructure;
  std::vector<SourcePointer> sources;
  std::vector<std::string> source_kinds;
  std::vector<Spectrum> spectra;  ///< of each source
  std::size_t wavelengths = 24;   ///< at most so many bands stand for them
  std::array<std::optional<Reflector>, kSides> reflectors;
  std::vector<Film> films;  ///< from the plate upwards
  LuminanceReceiverSpec luminance;
  std::optional<AngularReceiverSpec> angular;
  bool color = false;  ///< chromaticity of each cell of the luminance receiver
};

/// Reads and checks the map `backlight`. Faults are noted in the document of the node.
BacklightSpec read_backlight(const core::ConfigNode& backlight);

}  // namespace evenglow::tracer
