#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "tracer/microstructure/bump_facet.h"
#include "tracer/microstructure/dot_shape.h"
#include "tracer/microstructure/ray_span.h"

namespace evenglow::tracer {

/// Light among bumps of one shape that stand where the dots of a grid are, each of its own size: from facet to facet,
/// from bump to bump and to the bare face between them. `Shape`: as of `TracedBump`; only `height`, `span` and `normal`
/// are asked for. Coordinates: z from the face towards the tops of the bumps; x along that of the backlight, y along
/// it or, where `flip` is -1, against it. The side below z = 0 is that of the material that fills the bumps.
template <typename Shape>
class DotTrace {
 public:
  static constexpr int kMaxMeetings = 1000;  ///< what needs more counts as absorbed

  /// `face`: from the material of the bumps to that around them; `ratio`: of their refractive indices, n / n around.
  DotTrace(const Shape& shape, const DotGrid& dots, double flip, const DielectricFace& face, double ratio)
      : shape_(shape),
        dots_(dots),
        flip_(flip),
        face_(face),
        ratio_(ratio),
        height_(shape.height() * dots.greatest_radius()) {}

  bool meets(const core::Vec2& place, const core::Vec3& k) const {
    if (k.z() > 0.0) {
      if (dots_.covers(place.x(), flip_ * place.y())) return true;
      const double sin2_out = ratio_ * ratio_ * (k.x() * k.x() + k.y() * k.y());
      return sin2_out < 1.0 && touches(place, {ratio_ * k.x(), ratio_ * k.y(), std::sqrt(1.0 - sin2_out)});
    }
    return touches(place, -k) || touches(place, {k.x(), k.y(), -k.z()});
  }

  std::optional<DotShape::Outcome> sample(const core::Vec2& place, core::StokesVector light,
                                          core::PhotonRng& rng) const {
    Site at;
    at.p = {place.x(), place.y(), 0.0};
    const core::Vec3& k = light.frame.k;
    if (k.z() > 0.0) {
      at.dot = dots_.find(place.x(), flip_ * place.y());
      at.met = at.dot != nullptr ? kInside : kBareFromBelow;
    } else {
      const double back = std::min(height_ / -k.z(), kFarthest);
      at.p -= back * k;
      at.met = kOutside;
    }
    for (int meetings = 0; meetings < kMaxMeetings; ++meetings) {
      if (at.met == kInside) follow_inside(at, light.frame.k);
      if (at.met == kOutside) follow_outside(at, light.frame.k);
      if (at.met == kLeftDown || at.met == kLeftUp) return left(at, light);
      const bool from_inside = at.met != kFacetFromOutside && at.met != kBareFromAbove;
      const bool bare = at.met == kBareFromBelow || at.met == kBareFromAbove;
      const core::Vec3 normal = bare ? core::Vec3(core::Vec3::UnitZ()) : normal_at(at);
      const FacetMeeting meeting = meet_facet(face_, normal, light, from_inside, rng);
      light = meeting.light;
      const bool inside = from_inside != meeting.passed;
      at.met = !inside ? kOutside : bare ? kLeftDown : kInside;
    }
    return std::nullopt;
  }

 private:
  enum Met {
    kInside,
    kOutside,
    kFacetFromInside,
    kFacetFromOutside,
    kBareFromBelow,
    kBareFromAbove,
    kLeftDown,
    kLeftUp
  };
  static constexpr double kFarthest = 1e4;  // mm

  struct Site {
    core::Vec3 p = core::Vec3::Zero();
    Met met = kOutside;
    const DotGrid::Entry* dot = nullptr;
    int facet = 0;
  };

  /// A dot's own frame: its center, turned by its angle, in units of its radius.
  struct Frame {
    double x, y, cosine, sine, radius;
    core::Vec3 turn(const core::Vec3& v) const {
      return {cosine * v.x() + sine * v.y(), cosine * v.y() - sine * v.x(), v.z()};
    }
    core::Vec3 turn_back(const core::Vec3& v) const {
      return {cosine * v.x() - sine * v.y(), sine * v.x() + cosine * v.y(), v.z()};
    }
    core::Vec3 place(const core::Vec3& p) const { return turn({p.x() - x, p.y() - y, p.z()}) / radius; }
  };
  Frame frame_of(const DotGrid::Entry& dot) const {
    const core::Vec2 axis = dots_.axis(dot.dot);
    return {dots_.center_x(dot), flip_ * dots_.center_y(dot), axis.x(), flip_ * axis.y(),
            static_cast<double>(dot.radius)};
  }

  void follow_inside(Site& at, const core::Vec3& k) const {
    const Frame frame = frame_of(*at.dot);
    const RaySpan span = shape_.span(frame.place(at.p), frame.turn(k));
    at.p += std::max(0.0, span.leave) * frame.radius * k;
    at.facet = span.leave_face;
    at.met = span.leave_face == RaySpan::kFootprint ? kLeftDown : kFacetFromInside;
  }

  /// Way (mm) along which light beside the bumps comes to this one, and by which facet; infinite: never.
  double way_to(const DotGrid::Entry& dot, const core::Vec3& p, const core::Vec3& k, int& facet) const {
    // A ray that comes in over the rim of the footprint may enter at once, by rounding a little behind its place.
    constexpr double kTouch = 1e-9;
    const Frame frame = frame_of(dot);
    const RaySpan span = shape_.span(frame.place(p), frame.turn(k));
    const bool enters = span.enter < span.leave && span.enter > -kTouch && span.enter_face != RaySpan::kFootprint;
    if (!enters) return std::numeric_limits<double>::infinity();
    facet = span.enter_face;
    return std::max(0.0, span.enter) * frame.radius;
  }

  void follow_outside(Site& at, const core::Vec3& k) const {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const double to_end = k.z() > 0.0   ? std::max(0.0, height_ - at.p.z()) / k.z()
                          : k.z() < 0.0 ? std::max(0.0, at.p.z()) / -k.z()
                                        : kInfinity;
    double nearest = kInfinity;
    const DotGrid::Entry* met = nullptr;
    dots_.along(at.p.x(), flip_ * at.p.y(), k.x(), flip_ * k.y(), to_end, [&](auto entries, double way) {
      for (const DotGrid::Entry& dot : entries) {
        int facet = 0;
        const double to_dot = way_to(dot, at.p, k, facet);
        if (!(to_dot < nearest) || to_dot > to_end) continue;
        nearest = to_dot;
        met = &dot;
        at.facet = facet;
      }
      return nearest <= way;
    });
    if (met != nullptr) {
      at.p += nearest * k;
      at.dot = met;
      at.met = kFacetFromOutside;
    } else if (k.z() < 0.0) {
      at.p += to_end * k;
      at.p.z() = 0.0;
      at.met = kBareFromAbove;
    } else {
      at.met = kLeftUp;
    }
  }

  /// Does light that rises along u from the bare face, or came the other way, pass through a bump?
  bool touches(const core::Vec2& place, const core::Vec3& u) const {
    const core::Vec3 p(place.x(), place.y(), 0.0);
    bool touched = false;
    dots_.along(p.x(), flip_ * p.y(), u.x(), flip_ * u.y(), height_ / std::max(u.z(), 1e-300),
                [&](auto entries, double) {
                  for (const DotGrid::Entry& dot : entries) {
                    const Frame frame = frame_of(dot);
                    const RaySpan span = shape_.span(frame.place(p), frame.turn(u));
                    if (span.enter < span.leave && span.leave > 0.0) return touched = true;
                  }
                  return false;
                });
    return touched;
  }

  core::Vec3 normal_at(const Site& at) const {
    const Frame frame = frame_of(*at.dot);
    return frame.turn_back(shape_.normal(at.facet, frame.place(at.p)));
  }

  std::optional<DotShape::Outcome> left(const Site& at, core::StokesVector& light) const {
    // As many meetings as it may have had, the frame is one to rounding.
    core::Vec3& k = light.frame.k;
    k.normalize();
    light.frame.e1 = (light.frame.e1 - light.frame.e1.dot(k) * k).normalized();
    const double back = at.met == kLeftUp && k.z() > 0.0 ? at.p.z() / k.z() : 0.0;
    return DotShape::Outcome{light, {at.p.x() - back * k.x(), at.p.y() - back * k.y()}};
  }

  const Shape& shape_;
  const DotGrid& dots_;
  double flip_;
  const DielectricFace& face_;
  double ratio_, height_;
};

}  // namespace evenglow::tracer
