#include <array>
#include <limits>
#include <stdexcept>
#include <vector>

#include "seacrane/integrate/fixed_step.hpp"
#include "seacrane/integrate/phi_functions.hpp"
#include "seacrane/integrate/registry.hpp"

namespace seacrane {
namespace {

/// Step without a choice of the user (s), that of rk4.
constexpr double default_step = 0.02;

/// A linear block x' = a x + b(t, y) and what a step of length h needs of exp(a h).
class ExactBlock {
 public:
  explicit ExactBlock(const LinearBlock& block)
      : first_(block.first), a_(rows(block)), scaled_(a_.rows(), a_.cols()), phi_(a_.rows()) {
    for (VecXd* b : {&start_, &first_middle_, &second_middle_, &end_}) b->setZero(a_.rows());
  }

  void prepare(double h) {
    if (weights_[current_].h == h) return;
    current_ = 1 - current_;
    Weights& w = weights_[current_];
    if (w.h == h) return;
    w.h = h;
    scaled_ = 0.5 * h * a_;
    phi_.evaluate(scaled_);
    w.half = phi_[0];
    w.half_input = 0.5 * h * phi_[1];
    scaled_ = h * a_;
    phi_.evaluate(scaled_);
    w.whole = phi_[0];
    w.start = h * (phi_[1] - 3.0 * phi_[2] + 4.0 * phi_[3]);
    w.middle = h * (2.0 * phi_[2] - 4.0 * phi_[3]);
    w.end = h * (4.0 * phi_[3] - phi_[2]);
  }

  /// The stages of the method: x at the middle of the step, there again, and at its end, each from f at the
  /// stage before it, `y`; then x after the step.
  void first_middle(const double* y, const double* f, double* out) {
    take_input(y, f, start_);
    at(out).noalias() = now().half * at(y);
    at(out).noalias() += now().half_input * start_;
  }
  void second_middle(const double* start, const double* y, const double* f, double* out) {
    take_input(y, f, first_middle_);
    at(out).noalias() = now().half * at(start);
    at(out).noalias() += now().half_input * first_middle_;
  }
  /// `middle`: the first state in the middle.
  void end(const double* middle, const double* y, const double* f, double* out) {
    take_input(y, f, second_middle_);
    input_ = 2.0 * second_middle_ - start_;
    at(out).noalias() = now().half * at(middle);
    at(out).noalias() += now().half_input * input_;
  }
  void finish(const double* start, const double* y, const double* f, double* out) {
    take_input(y, f, end_);
    input_ = first_middle_ + second_middle_;
    at(out).noalias() = now().whole * at(start);
    at(out).noalias() += now().start * start_;
    at(out).noalias() += now().middle * input_;
    at(out).noalias() += now().end * end_;
  }

 private:
  struct Weights {
    double h = std::numeric_limits<double>::quiet_NaN();
    MatXd half, half_input, whole, start, middle, end;
  };

  static MatXd rows(const LinearBlock& block) {
    const auto n = static_cast<Eigen::Index>(block.size);
    return Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
        block.a.data(), n, n);
  }
  Eigen::Map<const VecXd> at(const double* y) const { return {y + first_, a_.rows()}; }
  Eigen::Map<VecXd> at(double* y) const { return {y + first_, a_.rows()}; }
  const Weights& now() const { return weights_[current_]; }
  void take_input(const double* y, const double* f, VecXd& b) const {
    b = at(f);
    b.noalias() -= a_ * at(y);
  }

  std::size_t first_;
  MatXd a_, scaled_;
  PhiFunctions phi_;
  // Of the usual step and of the last one cut short by a hard stop.
  std::array<Weights, 2> weights_;
  std::size_t current_ = 0;
  VecXd start_, first_middle_, second_middle_, end_, input_;
};

/// The classical Runge-Kutta method with the fluid memory (every linear block) propagated by its matrix
/// exponential, its input a quadratic polynomial through the stages: the exponential method ETD4RK [S. M.
/// Cox, P. C. Matthews, Exponential time differencing for stiff systems, J. Comput. Phys. 176 (2002) 430],
/// which is rk4 for all components outside the blocks. Whatever the step, a block's own decay is exact and
/// its response to an input that is quadratic in time too; the poles of the memory do not limit the step.
class RungeKuttaExactMemory final : public FixedStep {
 public:
  RungeKuttaExactMemory(System& system, const IntegratorOptions& options)
      : FixedStep("rk4-exact-memory", system, options, default_step),
        middle_(size()),
        stage_state_(size()),
        k2_(size()),
        k3_(size()),
        k4_(size()) {
    for (const LinearBlock& block : system.linear_blocks()) blocks_.emplace_back(block);
    if (blocks_.empty()) {
      throw std::invalid_argument(
          "integrator \"rk4-exact-memory\": this system has no fluid memory in states to propagate; choose "
          "\"rk4\"");
    }
  }

  int order() const override { return 4; }

 private:
  void advance(double h, double t_end) override;
  void move(double h, const std::vector<double>& slope, std::vector<double>& out) const {
    for (std::size_t i = 0; i < size(); ++i) out[i] = state_[i] + h * slope[i];
  }
  void slope(double h, double t, const std::vector<double>& y, std::vector<double>& k) {
    evaluate(t, y.data(), k.data());
    require_finite(h, k);
  }

  std::vector<ExactBlock> blocks_;
  std::vector<double> middle_, stage_state_, k2_, k3_, k4_;
};

void RungeKuttaExactMemory::advance(double h, double t_end) {
  const double* const start = state_.data();
  for (ExactBlock& block : blocks_) block.prepare(h);
  move(0.5 * h, start_derivative_, middle_);
  for (ExactBlock& block : blocks_) block.first_middle(start, start_derivative_.data(), middle_.data());
  slope(h, time_ + 0.5 * h, middle_, k2_);
  move(0.5 * h, k2_, stage_state_);
  for (ExactBlock& block : blocks_)
    block.second_middle(start, middle_.data(), k2_.data(), stage_state_.data());
  slope(h, time_ + 0.5 * h, stage_state_, k3_);
  // The end's stage goes where the step's result will stand.
  move(h, k3_, end_state_);
  for (ExactBlock& block : blocks_)
    block.end(middle_.data(), stage_state_.data(), k3_.data(), end_state_.data());
  slope(h, t_end, end_state_, k4_);
  stage_state_ = end_state_;
  for (std::size_t i = 0; i < size(); ++i) {
    end_state_[i] = state_[i] + h / 6.0 * (start_derivative_[i] + 2.0 * (k2_[i] + k3_[i]) + k4_[i]);
  }
  for (ExactBlock& block : blocks_) block.finish(start, stage_state_.data(), k4_.data(), end_state_.data());
}

}  // namespace

std::unique_ptr<Integrator> make_rk4_exact_memory(System& system, ResidualSystem* /*residual*/,
                                                  const IntegratorOptions& options) {
  return std::make_unique<RungeKuttaExactMemory>(system, options);
}

}  // namespace seacrane
