#include "seacrane/elements/loads/immersed_part.hpp"

#include "seacrane/math/clones.hpp"
#include "seacrane/math/pack.hpp"

namespace seacrane {
namespace {

constexpr int kSide = 4;  // parts side by side
using Parts = Pack<kSide>;
using Row = std::span<const ImmersedPart>;
using Shared = ImmersedPart::Shared<double>;

/// Calls f(first of so many parts side by side, arms, flow or none).
template <class F>
[[gnu::always_inline]] inline void for_each_pack(const Row& row, const Shared& as, F&& f) {
  LocalFlow<Parts> flow;
  for (std::size_t i = 0; i + kSide <= row.size(); i += kSide) {
    const ImmersedPart* const first = &row[i];
    const auto arm = [&](int k) { return Parts::by_lane([&](int lane) { return first[lane].arm[k]; }); };
    for (int lane = 0; lane < kSide && !as.row.empty(); ++lane) {
      LocalFlow<Parts>::each(as.row[idx(first[lane].place_in_row)], flow,
                             [&](double from, Parts& to) { to.set(lane, from); });
    }
    f(first, Vec3<Parts>(arm(0), arm(1), arm(2)), as.row.empty() ? nullptr : &flow);
  }
}

SEACRANE_CLONES("avx2")
void add_inertia_of_packs(const Row& row, Shared& as) {
  ImmersedRow<Parts> sum(as);
  const ImmersedForces& water = row.front().water;
  for_each_pack(row, as, [&](const ImmersedPart*, const Vec3<Parts>& arm, const LocalFlow<Parts>* flow) {
    water.add_inertia(arm, flow, sum);
  });
  as.add_lanes(sum);
}

SEACRANE_CLONES("avx2")
void apply_packs(const Row& row, Shared& as, LoadSum<double>& out) {
  ImmersedRow<Parts> sum(as);
  LoadSum<Parts> powers{nullptr};
  const ImmersedForces& water = row.front().water;
  for_each_pack(row, as,
                [&](const ImmersedPart* first, const Vec3<Parts>& arm, const LocalFlow<Parts>* flow) {
                  const Parts slam = water.apply(arm, flow, sum, powers);
                  for (int lane = 0; lane < kSide; ++lane) {
                    out.state_rates[first[lane].states.first] = slam[lane];
                  }
                });
  as.add_lanes(sum);
  out.power += total(powers.power);
  out.absolute_power += total(powers.absolute_power);
}

/// What fills no pack.
Row rest(const Row& row) { return row.last(row.size() % kSide); }

}  // namespace

void ImmersedPart::add_inertia(Row row, const LoadInput<double>& in, Mat6d* mass) {
  Shared<double> as = row.front().shared(in);
  if (row.size() >= kSide) add_inertia_of_packs(row, as);
  for (const ImmersedPart& one : rest(row)) one.add_inertia(in, as);
  row.front().put(as, mass);
}

void ImmersedPart::apply(Row row, const LoadInput<double>& in, LoadSum<double>& out) {
  Shared<double> as = row.front().shared(in);
  if (row.size() >= kSide) apply_packs(row, as, out);
  for (const ImmersedPart& one : rest(row)) one.apply(in, as, out);
  row.front().put(as, out);
}

}  // namespace seacrane
