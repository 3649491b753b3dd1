#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "seacrane/compile/steps.hpp"
#include "seacrane/dynamics/maximal.hpp"
#include "seacrane/elements/loads/line.hpp"
#include "seacrane/math/dense.hpp"
#include "seacrane/sea/sea_field.hpp"

namespace seacrane {
namespace {

constexpr std::size_t kMostCoupled = 64;  // lines; more of them are taken one by one
constexpr double kStill = 1e-9;           // of the fastest mode's square: strains that move nothing
constexpr double kAsMuch = 0.5;           // of a line's largest share in a mode
constexpr double kMassRounding = 1e-9;    // of a mass

/// What pulls along one direction: unit wrenches on the bodies, what they accelerate, and its stiffness.
struct Pull {
  std::vector<Vec6d> unit, response;
  double stiffness = 0.0;
  const Line* line = nullptr;
};

class BounceFinder {
 public:
  explicit BounceFinder(const Model& model) : model_(model), lines_(model.loads.of<Line>()) {}

  std::vector<LineBounce> run() {
    if (lines_.empty() || model_.paper_kinematics) return {};
    factor();
    for (const Line& line : lines_) {
      const auto pull = [&](Vec6d* w) {
        line.path.for_each_section<double>(input(), [&](const auto& s, std::size_t) { s.add_to(w, 1.0); });
      };
      add(pull, line.d.EA / line.d.length.at(0.0).value, &line);
    }
    if (lines_.size() > kMostCoupled) return one_by_one();
    add_others();
    return coupled();
  }

 private:
  void factor() {
    const double* y = model_.initial_state.data();
    system_.emplace(std::shared_ptr<const Model>(&model_, [](const Model*) {}));
    Terms& terms = system_->terms();
    terms.read(0.0, y);
    terms.evaluate_inertia(0.0, y + model_.layout.memory);
    terms.evaluate_rows(0.0);
    system_->solver().factor();
  }

  LoadInput<double> input() {
    return system_->terms().load_input(0.0, model_.initial_state.data() + model_.layout.memory);
  }

  template <class AddUnit>
  void add(AddUnit&& add_unit, double stiffness, const Line* line) {
    Pull out;
    out.unit.assign(idx(model_.body_count()) + 1, Vec6d::Zero());
    out.response = out.unit;
    add_unit(out.unit.data());
    out.unit.back().setZero();  // the ground
    out.stiffness = stiffness;
    out.line = line;
    system_->load_response(out.unit, out.response);
    const double yielding = yields(out, out);
    if (std::isfinite(yielding) && yielding > 0.0 && stiffness > 0.0) springs_.push_back(std::move(out));
  }

  /// What else holds what the lines hang on.
  void add_others() {
    model_.loads.for_each([&](const LoadList& list, std::size_t i) {
      const double stiffness = list.stiffness(i, input());
      if (stiffness > 0.0) add([&](Vec6d* w) { list.add_unit(i, 0, input(), w); }, stiffness, nullptr);
    });
  }

  static double yields(const Pull& one, const Pull& other) {
    double sum = 0.0;
    for (std::size_t b = 0; b < one.unit.size(); ++b) sum += one.unit[b].dot(other.response[b]);
    return sum;
  }

  std::vector<LineBounce> one_by_one() const {
    std::vector<LineBounce> out;
    for (const Pull& one : springs_) {
      const double mass = 1.0 / yields(one, one);
      out.push_back({one.line->d.name, mass, std::sqrt(one.stiffness / mass), one.line->d.damping_ratio});
    }
    return out;
  }

  /// By the modes of all springs together: the squares of an eigenvector are their shares of its energy.
  std::vector<LineBounce> coupled() const {
    const auto n = static_cast<Eigen::Index>(springs_.size());
    if (n == 0) return {};
    MatXd rates(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index j = 0; j <= i; ++j) {
        const Pull &a = springs_[idx(i)], &b = springs_[idx(j)];
        rates(i, j) = rates(j, i) = std::sqrt(a.stiffness * b.stiffness) * yields(a, b);
      }
    }
    const Eigen::SelfAdjointEigenSolver<MatXd> modes(rates);
    if (modes.info() != Eigen::Success) return one_by_one();
    const VecXd& squares = modes.eigenvalues();
    const MatXd shares = modes.eigenvectors().cwiseAbs2();
    std::vector<LineBounce> out;
    VecXd mass = VecXd::Zero(n);
    std::vector<Eigen::Index> mode(idx(n), 0);
    for (Eigen::Index i = 0; i < n; ++i) {
      if (springs_[idx(i)].line == nullptr) continue;
      mode[idx(i)] = bounce(squares, shares.row(i));
      mass[i] = snapped(*springs_[idx(i)].line, springs_[idx(i)].stiffness / squares[mode[idx(i)]]);
    }
    for (Eigen::Index i = 0; i < n; ++i) {
      if (springs_[idx(i)].line == nullptr) continue;
      const double omega = std::sqrt(squares[mode[idx(i)]]);
      double ratio = 0.0;
      for (Eigen::Index j = 0; j < n; ++j) {
        const Pull& other = springs_[idx(j)];
        if (other.line == nullptr) continue;
        const double moved = other.line->given_mass() ? other.line->hung : mass[j];
        ratio += shares(j, mode[idx(i)]) * other.line->d.damping_ratio * omega *
                 std::sqrt(moved / other.stiffness);
      }
      out.push_back({springs_[idx(i)].line->d.name, mass[i], omega, ratio});
    }
    return out;
  }

  /// The slowest mode in which a line has its share.
  static Eigen::Index bounce(const VecXd& squares, const VecXd& shares) {
    const double still = kStill * squares.maxCoeff();
    double most = 0.0;
    for (Eigen::Index k = 0; k < squares.size(); ++k) {
      if (squares[k] > still) most = std::max(most, shares[k]);
    }
    for (Eigen::Index k = 0; k < squares.size(); ++k) {
      if (squares[k] > still && shares[k] >= kAsMuch * most) return k;
    }
    return squares.size() - 1;
  }

  /// That of the ends where it is the same but for rounding.
  static double snapped(const Line& line, double mass) {
    return std::abs(mass - line.hung) <= kMassRounding * mass ? line.hung : mass;
  }

  const Model& model_;
  const std::vector<Line>& lines_;
  std::optional<MaximalSystem> system_;
  std::vector<Pull> springs_;
};

}  // namespace

std::vector<LineBounce> find_line_bounces(const Model& model) {
  if (!model.sea) return BounceFinder(model).run();
  Model still = model;
  still.sea = std::make_shared<const SeaField>(model.sea->without_waves());
  still.near = nullptr;
  return BounceFinder(still).run();
}

void hang_on_lines(Model& model, const std::vector<LineBounce>& bounces) {
  model.line_bounces = bounces;
  std::vector<Line>* const lines = model.loads.find<Line>();
  if (lines == nullptr) return;
  for (Line& line : *lines) {
    const auto found = std::find_if(bounces.begin(), bounces.end(),
                                    [&](const LineBounce& one) { return one.line == line.d.name; });
    if (found != bounces.end() && !line.given_mass()) line.hang(found->mass);
  }
}

}  // namespace seacrane
