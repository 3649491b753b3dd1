#include "seacrane/elements/check.hpp"

#include <sstream>

#include "seacrane/math/dense.hpp"

namespace seacrane {

std::string to_text(double value) {
  std::ostringstream out;
  out.precision(6);
  out << value;
  return out.str();
}

std::string Bound::fix(const std::string& meaning) const {
  if (not_zero) return "it must not be zero";
  if (!std::isfinite(maximum)) return above ? "it must be positive" : "it must not be negative";
  return std::string("give ") + (above ? "more than " : "") + to_text(minimum) + " to " +
         (below ? "below " : "") + to_text(maximum) + (meaning.empty() ? "" : " (" + meaning + ")");
}

void Check::number(const std::string& what, double v, const std::string& unit, const Bound& bound,
                   const std::string& when, const std::string& meaning) const {
  if (std::isfinite(v) && bound.holds(v)) return;
  const bool one = !unit.empty() && unit.find(',') == std::string::npos;  // else that of several entries
  fail(what + " is " + to_text(v) + (one ? " " + unit : "") + when + "; " +
       (std::isfinite(v) ? bound.fix(meaning) : "give a finite number"));
}

void Check::positive_definite(const char* what, const MatXd& m, bool semi) const {
  finite(what, m);
  const double size = m.cwiseAbs().maxCoeff();
  if ((m - m.transpose()).cwiseAbs().maxCoeff() > 1e-9 * size) {
    fail(std::string(what) + " is not symmetric; give a symmetric matrix");
  }
  const double smallest = Eigen::SelfAdjointEigenSolver<MatXd>(m).eigenvalues()[0];
  if (semi ? smallest < -1e-9 * size : !(smallest > 0.0)) {
    fail(std::string(what) + " is not positive " + (semi ? "semi-" : "") +
         "definite: its smallest eigenvalue is " + to_text(smallest));
  }
}

void SceneNames::coordinate(const Check& c, const CoordinateDescription& d) const {
  const auto joint = joints.find(d.joint);
  if (joint == joints.end()) c.fail("there is no joint '" + d.joint + "'; add it first");
  const auto& [kind, coordinates] = joint->second;
  if (coordinates.empty()) c.fail("joint '" + d.joint + "' is " + kind + " and offers no coordinate");
  std::istringstream offered(coordinates);
  for (std::string name; offered >> name;) {
    if (name == d.coordinate) return;
  }
  c.fail("joint '" + d.joint + "' has no coordinate '" + d.coordinate + "'; it offers: " + coordinates);
}

void SceneNames::input(const Check& c, const std::string& kind, const std::string& name) {
  const auto [owner, fresh] = input_owners.insert({name, kind});
  if (!fresh) {
    c.fail((owner->second == "actuator" ? "an " : "a ") + owner->second +
           " has this name too, and both would take the input '" + name + ".force'; rename one");
  }
}

}  // namespace seacrane
