#include "seacrane/run/sight.hpp"

#include <algorithm>
#include <cmath>

#include "seacrane/elements/loads/contact.hpp"
#include "seacrane/elements/loads/entrapped_water.hpp"
#include "seacrane/elements/loads/gas_spring.hpp"
#include "seacrane/elements/loads/hydraulic_cylinder.hpp"
#include "seacrane/elements/loads/immersed_part.hpp"
#include "seacrane/elements/loads/line.hpp"
#include "seacrane/elements/loads/seabed_node.hpp"
#include "seacrane/elements/loads/soft_stop.hpp"
#include "seacrane/elements/loads/spring_damper.hpp"
#include "seacrane/sea/sea_view.hpp"

namespace seacrane {
namespace {

using Input = LoadInput<double>;

// Bits of sides, in the order in which margins() of a load adds them.
constexpr int kSlack = 1 | 2, kHauledIn = 4;     // of a line
constexpr int kTouch = 1, kAwash = 2;            // of a part in the water
constexpr int kStrokeEnds = 1 << 4 | 1 << 5;     // of a cylinder
constexpr int kLengthEnds = 1 | 2, kSeabed = 1;  // of a gas spring, of a node
/// Of a compartment: above the water outside.
constexpr int dry_opening(std::size_t i) { return 1 << (4 + 2 * i); }

/// Velocity of a point of a body, from its state point in its axes.
Vec3d velocity_of(const BodyKinematics<double>& k, const Vec3d& point) {
  return k.velocity + k.angular_velocity.cross(k.rotation * point);
}

/// Points that do not press: those of a ball about all of them while that is outside. One that is torn off is
/// at the surface.
Sight from(const Contact& load, const Input& in, int side) {
  const auto &b = in.bodies[load.body], &s = in.bodies[load.on];
  const Vec3d lever = b.rotation * load.center, ball = b.position + lever - s.position;
  const Vec3d over =
      b.velocity + b.angular_velocity.cross(lever) - s.velocity - s.angular_velocity.cross(ball);
  Sight out{.pace = over.norm() + (b.angular_velocity - s.angular_velocity).norm() * load.radius,
            .thin = load.surface.thin(),
            .strikes = true,
            .at = load.axes.transpose() * (s.rotation.transpose() * ball - load.place)};
  const double apart = load.surface.at<double>(out.at).distance - load.radius;
  for (std::size_t i = 0; i < load.points.size(); ++i) {
    if ((side & Contact::closed(i)) != 0) continue;
    out.watched |= Contact::closed(i);
    out.clear = std::min(out.clear, apart > 0.0 ? apart : std::max(0.0, load.touch(in, i).gap));
  }
  return out;
}

Sight from(const SoftStop& load, const Input& in, int side) {
  const auto &a = in.bodies[load.coordinate.joint.first], &b = in.bodies[load.coordinate.joint.second];
  const CoordinateRow<double> row = evaluate_coordinate<double>(load.coordinate, a, b);
  if (side != 0) return {.pace = std::abs(coordinate_rate<double>(row, a, b))};
  return {.watched = ~0,
          .clear = std::max(0.0, std::min(row.value - load.d.minimum, load.d.maximum - row.value)),
          .pace = std::abs(coordinate_rate<double>(row, a, b)),
          .strikes = true,
          .at = {row.value, 0.0, 0.0}};
}

/// The corners of its table beside its length.
Sight from(const SpringDamper& load, const Input& in, int side) {
  const SpanMotion<double> now = load.span.motion(in);
  Sight out{.watched = ~0, .pace = std::abs(now.rate), .at = {now.length, 0.0, 0.0}};
  const std::size_t next = idx(side);
  if (next < load.d.lengths.size()) out.clear = load.d.lengths[next] - now.length;
  if (next > 0) out.clear = std::min(out.clear, now.length - load.d.lengths[next - 1]);
  return out;
}

Sight from(const GasSpring& load, const Input& in, int side) {
  if ((side & kLengthEnds) != 0) return {};
  const SpanMotion<double> now = load.span.motion(in);
  return {.watched = kLengthEnds,
          .clear = std::max(0.0, std::min(load.d.maximum - now.length, now.length - load.d.minimum)),
          .pace = std::abs(now.rate),
          .at = {now.length, 0.0, 0.0}};
}
Sight from(const HydraulicCylinder& load, const Input& in, int side) {
  if ((side & kStrokeEnds) != 0) return {};
  const SpanMotion<double> now = load.span.motion(in);
  const double stroke = now.length - load.d.retracted_length;
  return {.watched = kStrokeEnds,
          .clear = std::max(0.0, std::min(stroke, load.d.stroke - stroke)),
          .pace = std::abs(now.rate),
          .at = {stroke, 0.0, 0.0}};
}

Sight from(const SeabedNode& load, const Input& in, int side) {
  if ((side & kSeabed) != 0) return {};
  const auto& k = in.bodies[load.body];
  Sight out{.watched = kSeabed, .pace = velocity_of(k, load.point).norm()};
  out.at = k.position + k.rotation * load.point;
  out.clear = std::max(0.0, out.at.z() + load.d.depth);
  return out;
}

/// A slack line may snatch; one on a winch comes to its end.
Sight from(const Line& load, const Input& in, int side) {
  const bool is_slack = (side & kSlack) == kSlack, winds = load.winch && (side & kHauledIn) == 0;
  if (!is_slack && !winds) return {};
  const Line::Motion<double> now = load.motion(in);
  Sight out;
  if (is_slack) {
    out = {.watched = kSlack,
           .clear = std::max(0.0, -now.stretch()),
           .pace = std::abs(now.straining()),
           .strikes = true};
    out.at[0] = now.stretch();
  }
  if (!winds) return out;
  out.watched |= kHauledIn;
  out.pace = std::max(out.pace, std::abs(load.winch->rate(in, now.elastic)));
  out.at[1] = load.winch->length(in);
  out.clear = std::min(out.clear, std::max(0.0, out.at[1] - load.d.minimum_length));
  return out;
}

/// A part above all crests has these to come down to; others see the water where they are.
Sight from(const ImmersedPart& load, const Input& in) {
  const Margins margins = load.margins(in);
  const auto& k = in.bodies[load.body];
  Sight out{.side = margins.side(), .watched = kTouch | kAwash};
  out.clear = margins.across(out.side, out.side ^ out.watched);
  out.at[0] = (out.side & kTouch) != 0 ? -out.clear : out.clear;
  const double crest = in.sea->crest(load.stencil);
  if ((out.side & kTouch) == 0 && out.clear > crest) out.clear -= crest;
  out.pace = velocity_of(k, load.point).norm() + k.angular_velocity.norm() * load.d.size.norm();
  return out;
}

/// Openings, which the water outside comes to and leaves.
Sight from(const EntrappedWater& load, const Input& in, int side) {
  const auto& k = in.bodies[load.body];
  Sight out{.at = k.position};
  double crest = 0.0;
  for (std::size_t i = 0; i < load.openings.size(); ++i) {
    out.watched |= dry_opening(i);
    out.pace = std::max(out.pace, velocity_of(k, load.openings[i].point).norm());
    if ((side & dry_opening(i)) != 0) crest = std::max(crest, in.sea->crest(load.openings[i].stencil));
  }
  if (out.watched == 0) return out;
  out.clear = load.across(in, side, side ^ out.watched);
  if (out.clear > crest) out.clear -= crest;
  return out;
}

template <class Load>
bool sees(const LoadList& list, std::size_t i, const Input& in, Sight& out) {
  if (&list.kind != &load_kind<Load>()) return false;
  const Load& load = static_cast<const LoadsOf<Load>&>(list).items[i];
  if constexpr (requires { from(load, in); }) {
    out = from(load, in);
  } else {
    const int side = load.side(in);
    out = from(load, in, side);
    out.side = side;
  }
  return true;
}

template <class... Loads>
Sight look_as(const LoadList& list, std::size_t i, const Input& in) {
  Sight out;
  if (!(sees<Loads>(list, i, in, out) || ...)) out.side = list.side(i, in);
  return out;
}

}  // namespace

Sight look(const LoadList& list, std::size_t i, const LoadInput<double>& in) {
  return look_as<Contact, Line, ImmersedPart, SeabedNode, SpringDamper, SoftStop, GasSpring,
                 HydraulicCylinder, EntrappedWater>(list, i, in);
}

}  // namespace seacrane
