#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "core/light/mueller.h"
#include "tracer/polarized_bsdf/bsdf_table.h"
#include "tracer/polarized_bsdf/reconstruction.h"

namespace evenglow::tracer {

struct StoredTable;

/// Angle (rad) from the first axis of an outgoing ray's tangential frame to the film's axis: psi less the azimuth of
/// the ray at (phi, theta) from the specular or the direct axis of an incidence at `sigma` (both have the same
/// tangential part).
double outgoing_psi(double psi, double sigma, double phi, double theta);

/// Mueller matrices of a film (1/sr) on the grid of angles of a `BsdfTable`, as `film reconstruct` finds them from
/// readings behind polarizers in both channels (docs/films.md).
///
/// Inside, matrices are in frames turned to the film's axis: the incident one by psi, the outgoing one by
/// `outgoing_psi`; tangential count. There they change slowly with direction.
///
/// Interpolation. m00 as S / 2 of a `BsdfTable` (logarithm, splines); M / m00 linearly in every dimension (psi and phi
/// around the circle, sin^2 sigma, theta or theta^2, lambda). So what is interpolated is a mean of physical matrices
/// with weights >= 0: physical (Cloude 1986: the coherency matrix is linear in M). Linear polarization follows the same
/// rule as in a `BsdfTable`.
class MuellerTable {
 public:
  /// `frames`: in which the file counts (none: what its comment says, else film). Throws `core::ConfigError`: a table
  /// of another form. Entries that miss to be physical by rounding are mixed with a depolarizer until they are.
  explicit MuellerTable(const StoredTable& table, std::optional<AngleOrigin> frames = {});
  static MuellerTable read(const std::filesystem::path& file, std::optional<AngleOrigin> frames = {});

  /// The first row but m03, as a table: S = 2 m00, D (cos 2 delta, sin 2 delta) = -2 (m01, m02).
  const BsdfTable& intensities() const { return intensities_; }
  const BsdfTable::Axes& axes() const { return intensities_.axes(); }
  bool has(ScatterKind kind) const { return intensities_.has(kind); }
  AngleOrigin frames() const { return frames_; }  ///< of the file

  /// The outgoing directions of one incidence.
  class Slice {
   public:
    /// As `BsdfTable::Slice::at`.
    core::MuellerMatrix at(double phi, double theta) const;

   private:
    friend class MuellerTable;
    const MuellerTable* table_ = nullptr;
    BsdfTable::Slice intensities_;
    std::vector<core::MuellerMatrix> shares_;  ///< M / m00; index theta * n_phi + phi
  };
  /// The table must outlive it. `kind` must be there.
  Slice slice(ScatterKind kind, double psi, double sigma, double lambda_nm) const;

 private:
  using Matrices = std::array<std::vector<core::MuellerMatrix>, 2>;  ///< by kind, index as in `BsdfTable::from_nodes`
  MuellerTable(const StoredTable& table, AngleOrigin frames, BsdfTable::Axes axes, Matrices matrices);

  AngleOrigin frames_;
  BsdfTable intensities_;
  Matrices shares_;  ///< M / m00; of a matrix of zeros the ideal depolarizer
  PeriodicSpline psi_, phi_;
};

}  // namespace evenglow::tracer
