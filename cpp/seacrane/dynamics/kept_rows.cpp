#include "seacrane/dynamics/kept_rows.hpp"

#include <algorithm>
#include <cmath>

#include "seacrane/model/model.hpp"

namespace seacrane {
namespace {

constexpr double kOpen = 1e-6;    // m or rad
constexpr double kMissed = 1e-4;  // of the accelerations along it: what its drift makes of them is less

}  // namespace

bool stands_open(const RowBlock<double>& block, int row) { return std::abs(block.phi[row]) > kOpen; }

bool is_missed(const RowBlock<double>& block, int row, const Vec6d& first, const Vec6d& second) {
  const double left = block.gamma[row] - block.d[0].row(row).dot(first) - block.d[1].row(row).dot(second);
  const double size = std::abs(block.gamma[row]) + block.d[0].row(row).norm() * first.norm() +
                      block.d[1].row(row).norm() * second.norm();
  return std::abs(left) > kMissed * size;
}

LeftOutRows::LeftOutRows(const Model& model) {
  if (model.left_out.empty()) return;
  for (std::size_t e = 0; e < model.elements.size(); ++e) {
    const ElementModel& element = model.elements[e];
    for (int r = 0; r < element.rows; ++r) {
      if (!model.left_out[idx(element.row + r)]) continue;
      rows_.push_back({e, idx(element.first), idx(element.second), r});
    }
  }
}

bool LeftOutRows::stand_open(const RowBlock<double>* blocks) const {
  return std::ranges::any_of(rows_, [&](const Row& r) { return stands_open(blocks[r.element], r.row); });
}

bool LeftOutRows::are_missed(const RowBlock<double>* blocks, const Vec6d* acceleration) const {
  return std::ranges::any_of(rows_, [&](const Row& r) {
    return is_missed(blocks[r.element], r.row, acceleration[r.first], acceleration[r.second]);
  });
}

}  // namespace seacrane
