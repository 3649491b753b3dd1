// The loads of a batch for `mujoco.rollout`, whose threads call them without
// Python. A model's number `member` says which are its own.
#include <mujoco/mujoco.h>

#include <vector>

#include "loads.hpp"

namespace {
std::vector<Loads> batch;
}

extern "C" int add_loads(const char *tree) try {
  batch.emplace_back(TreeData(tree));
  return static_cast<int>(batch.size()) - 1;
} catch (const std::exception &) {
  return -1;
}

extern "C" void apply_loads(const mjModel *m, mjData *d) {
  std::array<double, coordinates> load;
  batch[static_cast<std::size_t>(m->numeric_data[0])](d->time, d->qpos, d->qvel,
                                                       load.data());
  for (int i = 0; i < coordinates; ++i)
    d->qfrc_passive[i] += load[i];
}
