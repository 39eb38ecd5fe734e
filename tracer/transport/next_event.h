#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "core/light/stokes.h"
#include "tracer/scene/density_field.h"
#include "tracer/scene/scene.h"
#include "tracer/transport/batch_sums.h"
#include "tracer/transport/pattern_dots.h"
#include "tracer/transport/viewer_levels.h"
#include "tracer/transport/viewer_subpath.h"

namespace evenglow::tracer {

/// The next-event estimate of the luminance: what a scatter is expected to send to the viewer through all that lies
/// above it, found by joining it to paths built backwards from the viewer (`ViewerSubpath`). Every photon remembers
/// whether its way to the viewer has been estimated (`Coverage`); if so, neither its later scatters nor its escape are
/// scored, until it does something that the subpaths do not know. So each path of light counts once (docs/theory.md).
class NextEvent {
 public:
  NextEvent(const Scene& scene, const DensityField& density);

  /// Whether what a photon may still send to the viewer is estimated already, as long as it goes from level to level.
  struct Coverage {
    bool covered = false;
    int level = -1;                          ///< that the photon met last
    core::Vec2 origin = core::Vec2::Zero();  ///< where it was estimated, mm
    double reach = 0.0;                      ///< how far from there the light may leave to be covered, mm
    bool straight =
        false;           ///< it comes straight from a plain dot, through the plate, but for total reflection at walls
    unsigned walls = 0;  ///< pairs of walls where it was reflected: 1 for x = const, 2 for y = const
  };

  /// What a path tells of light in the plate that comes to the patterned face.
  enum class PatternTold {
    kMet,   ///< it is told where it meets the pattern
    kEach,  ///< and where it meets the smooth part of the face
    kDone   ///< the path has seen to `estimate_pattern`
  };

  /// A photon at a surface.
  struct Meeting {
    int quad;
    const Bsdf& optics;               ///< what it meets there
    const core::StokesVector& light;  ///< incident, in the frame of the surface
    const core::Vec3& position;
    std::size_t band;
    const core::Vec3& weight;  ///< X, Y, Z that the photon carries
    PatternTold told = PatternTold::kMet;
  };

  /// To be told of every meeting before the surface acts on the photon: adds the estimate if one is due. True: done.
  bool meet(Coverage& coverage, const Meeting& meeting, BatchSums& sums) const;
  /// And after it; `estimated`: the answer of `meet`; `specular`: of the sample (`BsdfSample`).
  void leave(Coverage& coverage, const Meeting& meeting, bool estimated, bool specular) const;
  /// For paths that do not tell `meet` of smooth walls of the plate that are met from inside: `side` of the four, the
  /// direction k in the plate.
  void meet_wall(Coverage& coverage, int side, const core::Vec3& k, std::size_t band) const;
  /// Is a photon that leaves the backlight at `position` estimated already?
  bool covers(const Coverage& coverage, const core::Vec3& position) const;

  const ViewerLevels& levels() const { return levels_; }
  bool active() const { return active_; }

  // A pattern that scatters (white dots) can be estimated more often than it is met: at each arrival at its face with
  // the density d, whether or not the pattern is met, `estimates`(-ln(1 - d)) times on average, and with d over that.
  // So the light spreads over all cells that it comes by. `meet` does it where it is told of each arrival; a path that
  // goes through many in one step does it by itself. A pattern that is traced dot by dot has densities 0 and 1: it is
  // estimated where it is met, and nowhere else.

  /// At most 1; about `kMoreOften` times the odds of meeting the pattern. `depth`: -ln(1 - density).
  static double estimates(double depth) { return std::min(1.0, kMoreOften * depth); }
  /// Does the pattern scatter, on a level?
  bool estimates_pattern(std::size_t band) const { return active_ && pattern_level_[band] >= 0; }
  /// A uniform number that is not one of the photon's.
  double number(std::size_t band, BatchSums& sums) const { return pool_of(band, sums).rng().uniform(); }
  /// An estimate that is due; `meeting.optics`: the pattern.
  void estimate_pattern(const Meeting& meeting, BatchSums& sums) const;

 private:
  static constexpr double kMoreOften = 4.0;

  /// What a level is made of at one wavelength, and the BRDF (1/sr) of what is Lambertian and forgets the polarization,
  /// as dots and white sheets are; < 0: of another kind.
  struct LevelOptics {
    const Bsdf* base = nullptr;
    const Bsdf* pattern = nullptr;
    double base_brdf = -1.0, pattern_brdf = -1.0;
    double per_n2_above = 1.0, per_n2_below = 1.0;  ///< 1 / n^2 of the media
  };
  const LevelOptics& optics_of(int level, std::size_t band) const {
    return optics_[band * levels_.all().size() + static_cast<std::size_t>(level)];
  }
  LevelOptics level_optics(int level, std::size_t band) const;
  ViewerPool& pool_of(std::size_t band, BatchSums& sums) const {
    return sums.viewer.of_band(band, levels_.all().size());
  }
  void arrive_at_pattern(const Meeting& meeting, BatchSums& sums) const;
  void estimate(const Meeting& meeting, int level, double brdf, std::size_t part, BatchSums& sums) const;
  /// The light that is scattered to one side of the level, joined to the usual number of arrivals there over `part`.
  void join(const Meeting& meeting, std::size_t list, double brdf, std::size_t part, ViewerPool& pool,
            BatchSums& sums) const;
  double scattered_power(const Meeting& meeting, const ViewerArrival& arrival, double brdf) const;
  double open_share(const ViewerArrivals& arrivals, const ViewerArrival& arrival, const core::Vec2& at,
                    std::size_t band) const;
  void tell_crossings(const ViewerArrivals& arrivals, const ViewerArrival& arrival, const core::Vec2& at,
                      ArrivalLog& log) const;
  void find_fits(ViewerArrivals& arrivals) const;
  static bool inside(const ViewerArrival& arrival, const core::Vec2& at);
  /// The cell of the density field at a place, as `CellGrid::nearest_index`, without divisions.
  std::size_t cell_at(const core::Vec2& place) const {
    const core::CellGrid& grid = density_.cells.grid;
    const int ix = std::clamp(static_cast<int>((place.x() - grid.x0) * per_cell_.x()), 0, grid.nx - 1);
    const int iy = std::clamp(static_cast<int>((place.y() - grid.y0) * per_cell_.y()), 0, grid.ny - 1);
    return static_cast<std::size_t>(iy) * static_cast<std::size_t>(grid.nx) + static_cast<std::size_t>(ix);
  }
  void renew(ViewerPool& pool, std::size_t band) const;
  void set_joins(ViewerPool& pool) const;
  void find_walls();
  /// A place that an arrival is moved to: that of the scatter, or its mirror image in walls of the plate.
  struct Anchor {
    core::Vec2 place;
    bool x = false, y = false;  ///< mirrored
  };
  std::size_t anchors(const core::Vec2& at, bool with_images, std::size_t band, std::array<Anchor, 4>& all) const;
  bool reflects_totally(const core::Vec3& k, int axis, std::size_t band) const {
    return plate_index_[band] * plate_index_[band] * (1.0 - k[axis] * k[axis]) >= 1.0;
  }
  void score(const Meeting& meeting, const ViewerArrival& arrival, const core::Vec2& anchor, double factor,
             const ViewerPool& pool, BatchSums& sums) const;
  void renew_for(const Meeting& meeting, ViewerPool& pool) const;
  double reach(const core::Vec3& position) const;

  const Scene& scene_;
  const DensityField& density_;
  PatternDots dots_;
  ViewerLevels levels_;
  ViewerSubpath subpath_;
  bool active_;
  std::vector<LevelOptics> optics_;  ///< band, level
  std::vector<int> pattern_level_;   ///< of each band, where its pattern scatters; -1: nowhere
  std::vector<double> plate_index_;  ///< of each band; 0 without a plate whose walls can be unfolded
  std::vector<int> wall_of_quad_;    ///< the side (0 to 3) whose smooth plate wall this quad is, -1: none
  std::array<bool, 4> smooth_wall_{};
  std::vector<double> density_per_estimate_;  ///< of each cell of the density field
  core::Vec2 inner_min_, inner_max_, outer_min_, outer_max_;
  core::Vec2 per_cell_;  ///< 1/mm, of the density field
};

}  // namespace evenglow::tracer
