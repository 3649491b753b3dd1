#include "seacrane/integrate/arkode.hpp"
#include "seacrane/integrate/registry.hpp"

namespace seacrane {
namespace {

/// ARKODE's explicit stepper with the Dormand-Prince 5(4) pair: the same formulas as dopri5, written by
/// others, with their own error control and dense output; it checks dopri5.
class ArkodeExplicit final : public ArkodeIntegrator {
 public:
  ArkodeExplicit(System& system, const IntegratorOptions& options)
      : ArkodeIntegrator("ark-erk", 5, sundials::explicit_stepper(), system, options) {}

 private:
  void* make() override {
    void* const memory = ERKStepCreate(derivative, time_, solution_vector_.get(), context_.get());
    if (memory != nullptr) sundials::record_erk_messages(memory, messages_);
    return memory;
  }
  void attach(void* memory) override {
    require(ERKStepSetTableNum(memory, ARKODE_DORMAND_PRINCE_7_4_5), "ERKStepSetTableNum");
  }
  int reinitialise(void* memory) override {
    return ERKStepReInit(memory, derivative, time_, solution_vector_.get());
  }
};

}  // namespace

std::unique_ptr<Integrator> make_ark_erk(System& system, ResidualSystem* /*residual*/,
                                         const IntegratorOptions& options) {
  return std::make_unique<ArkodeExplicit>(system, options);
}

}  // namespace seacrane
