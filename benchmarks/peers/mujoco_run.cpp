// MuJoCo: kinematic tree, loops closed by soft `connect` constraints, its own
// integrators. mujoco_run TREE MODEL.xml INTEGRATOR(rk4|implicitfast|euler)
// STEP(s) TIMECONST(s) REPEATS
#include <mujoco/mujoco.h>

#include <cstdio>
#include <ctime>
#include <exception>
#include <memory>

#include "loads.hpp"

namespace {

const Loads *loads = nullptr; // MuJoCo's callback takes no user data
long evaluations = 0;

void apply_loads(const mjModel *, mjData *d) {
  std::array<double, coordinates> load;
  (*loads)(d->time, d->qpos, d->qvel, load.data());
  for (int i = 0; i < coordinates; ++i)
    d->qfrc_passive[i] += load[i];
  ++evaluations;
}

int integrator(const std::string &name) {
  if (name == "rk4")
    return mjINT_RK4;
  if (name == "implicitfast")
    return mjINT_IMPLICITFAST;
  if (name == "euler")
    return mjINT_EULER;
  throw std::runtime_error("unknown integrator " + name);
}

} // namespace

int main(int count, char **arguments) try {
  if (count != 7)
    throw std::runtime_error(
        "needs TREE MODEL INTEGRATOR STEP TIMECONST REPEATS");
  const TreeData tree(arguments[1]);
  const Loads own(tree);
  loads = &own;
  char message[1000] = "";
  const std::unique_ptr<mjModel, decltype(&mj_deleteModel)> model(
      mj_loadXML(arguments[2], nullptr, message, sizeof message),
      mj_deleteModel);
  if (!model)
    throw std::runtime_error(message);
  if (model->nv != coordinates || model->nq != coordinates)
    throw std::runtime_error("coordinates");
  model->opt.integrator = integrator(arguments[3]);
  const long per_second = std::lround(1.0 / std::stod(arguments[4]));
  model->opt.timestep = 1.0 / double(per_second);
  model->opt.disableflags |=
      mjDSBL_REFSAFE; // else time constants are kept above two steps
  for (int i = 0; i < model->neq; ++i) {
    model->eq_solref[mjNREF * i] = std::stod(arguments[5]);
    model->eq_solref[mjNREF * i + 1] = 1.0;
    model->eq_solimp[mjNIMP * i] = model->eq_solimp[mjNIMP * i + 1] =
        0.9999; // the stiffest it takes
  }
  const std::unique_ptr<mjData, decltype(&mj_deleteData)> data(
      mj_makeData(model.get()), mj_deleteData);
  mjcb_passive = apply_loads;
  const int payload = mj_name2id(model.get(), mjOBJ_BODY, "payload");
  double best = 1e300;
  std::vector<std::array<double, 4>> rows;
  for (int repeat = 0; repeat < std::stoi(arguments[6]); ++repeat) {
    mj_resetData(model.get(), data.get());
    evaluations = 0;
    rows.clear();
    const std::clock_t begin = std::clock();
    for (int second = 0; second <= 100; ++second) {
      for (long step = 0; second > 0 && step < per_second; ++step)
        mj_step(model.get(), data.get());
      mj_kinematics(model.get(), data.get());
      mj_comPos(model.get(), data.get());
      const double *p = data->xipos + 3 * payload;
      rows.push_back({p[0], p[1], p[2], data->qpos[roll]});
    }
    best = std::fmin(best, double(std::clock() - begin) / CLOCKS_PER_SEC);
  }
  std::printf("%.9g %ld %ld 0\n", best, evaluations, 100 * per_second);
  for (const auto &row : rows)
    std::printf("%.17g %.17g %.17g %.17g\n", row[0], row[1], row[2], row[3]);
  return 0;
} catch (const std::exception &error) {
  std::fprintf(stderr, "%s: %s\n", arguments[0], error.what());
  return 1;
}
