#pragma once

namespace evenglow::tracer {

/// What bounds a cell of a prism film's cross-section.
enum class PrismPart {
  kNone,
  kRight,  ///< facet whose outward normal leans towards +y
  kLeft,   ///< facet whose outward normal leans towards -y
  kTip,    ///< flat or rounded top
  kOpen    ///< no face: the level of the valleys (z = 0) inside, the level of the tips (z = height) outside
};

/// A point of the cross-section, mm. z counts from the valleys. Inside the film y counts from the tip of the prism and
/// lies in [-pitch/2, pitch/2]; outside it counts from the valley of the groove between two prisms, likewise.
struct PrismPoint {
  double y = 0.0;
  double z = 0.0;
};

struct PrismHit {
  PrismPart part = PrismPart::kNone;
  double distance = 0.0;  ///< in units of the direction's length: mm along the ray for a unit direction in space
  PrismPoint point;
  double normal_y = 0.0, normal_z = 1.0;  ///< unit, out of the film; not set for `kOpen`
};

/// Cross-section of a film of equal, symmetric, straight prisms that touch each other: two facets, the tip sharp, flat,
/// or rounded by an arc that the facets are tangents of.
class PrismProfile {
 public:
  struct Shape {
    double pitch = 0.05;               ///< mm, > 0
    double apex = 1.5707963267948966;  ///< rad, angle between the facets, in (0, pi)
    double tip_flat = 0.0;             ///< mm, width of the flat tip, in [0, pitch)
    double tip_radius = 0.0;           ///< mm, of the arc; its width 2 radius cos(apex / 2) below the pitch
  };
  /// `core::Error` outside these ranges, or if both tips are given.
  explicit PrismProfile(const Shape& shape);

  double pitch() const { return 2.0 * half_pitch_; }
  double height() const { return height_; }  ///< mm, from valley to tip

  /// Where a ray inside the prism leaves it. (dy, dz) are the direction's components in the cross-section, not both 0;
  /// `skip`: the flat face that it starts from.
  PrismHit inside(const PrismPoint& from, double dy, double dz, PrismPart skip) const;
  /// What a ray in the air below the tips meets next.
  PrismHit outside(const PrismPoint& from, double dy, double dz, PrismPart skip) const;

  /// The same point counted from the prism, or from the groove, on the other side of a face with this normal.
  PrismPoint from_prism_to_groove(const PrismPoint& point, double normal_y) const;
  PrismPoint from_groove_to_prism(const PrismPoint& point, double normal_y) const;
  /// y brought into [-pitch/2, pitch/2] by whole periods.
  double wrapped(double y) const;

 private:
  PrismHit facet_hit(PrismPart part, double distance, const PrismPoint& from, double dy, double dz) const;
  PrismHit open_hit(double level, const PrismPoint& from, double dy, double dz) const;
  PrismHit arc_hit(double distance, double center_y, const PrismPoint& from, double dy, double dz) const;
  void meet_outer_facet(PrismPart part, const PrismPoint& from, double dy, double dz, PrismHit& best) const;
  void meet_outer_arc(double center_y, const PrismPoint& from, double dy, double dz, PrismHit& best) const;

  double half_pitch_;
  double normal_y_, normal_z_;  ///< of the right facet
  double offset_;               ///< of its line in the prism's count: normal . p = offset
  double height_;
  double shoulder_;  ///< z where the facets end
  double flat_;      ///< half width of the flat tip
  double radius_;
  double center_z_;  ///< of the arc
};

}  // namespace evenglow::tracer
