#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "seacrane/math/types.hpp"

namespace seacrane {

inline constexpr const char* kGround = "ground";

/// A scene that contradicts itself or holds a value out of range; the message names object, value, fix.
class SceneError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

std::string to_text(double value);

inline constexpr double kFarthest = 1e7;  // m

/// What a number must be besides finite.
struct Bound {
  double minimum = -std::numeric_limits<double>::infinity(),
         maximum = std::numeric_limits<double>::infinity();
  bool above = false, below = false;  // the minimum, or the maximum, is refused itself
  bool not_zero = false;

  bool holds(double v) const {
    return (above ? v > minimum : v >= minimum) && (below ? v < maximum : v <= maximum) &&
           !(not_zero && v == 0.0);
  }
  /// What to give instead.
  std::string fix(const std::string& meaning) const;
};

/// Checks of one named element; every failure reads "<kind> '<name>': <what>".
class Check {
 public:
  Check(std::string kind, const std::string& name) : prefix_(std::move(kind) + " '" + name + "': ") {
    if (name.empty()) fail("the name is empty; give every element a name");
  }

  [[noreturn]] void fail(const std::string& what) const { throw SceneError(prefix_ + what); }

  /// In the message `when` follows the number, and `meaning` a range.
  void number(const std::string& what, double v, const std::string& unit, const Bound& bound,
              const std::string& when = "", const std::string& meaning = "") const;
  void finite(const char* what, double v) const { number(what, v, "", {}); }
  template <class Derived>
  void finite(const char* what, const Eigen::MatrixBase<Derived>& m) const {
    for (Eigen::Index i = 0; i < m.rows(); ++i) {
      for (Eigen::Index j = 0; j < m.cols(); ++j) {
        if (!std::isfinite(m(i, j))) {
          fail(std::string(what) + " holds " + to_text(m(i, j)) + " at (" + std::to_string(i) + ", " +
               std::to_string(j) + "); give finite numbers");
        }
      }
    }
  }
  /// The flat frame and its resolution in double precision both end long before this.
  void near(const char* what, const Vec3d& point) const {
    finite(what, point);
    if (!(point.cwiseAbs().maxCoeff() <= kFarthest)) {
      fail(std::string(what) + " holds " + to_text(point.cwiseAbs().maxCoeff()) +
           " m; give metres, at most " + to_text(kFarthest));
    }
  }
  void increases(const char* what, const std::vector<double>& values) const {
    if (std::adjacent_find(values.begin(), values.end(), std::greater_equal<>()) == values.end()) return;
    fail(std::string(what) + " must increase");
  }
  void positive_definite(const char* what, const MatXd& m, bool semi) const;

 private:
  std::string prefix_;
};

/// One coordinate of a joint: second body relative to first, in the first body's joint frame. Which ones a
/// joint offers stands with its type.
struct CoordinateDescription {
  std::string joint, coordinate;
};

/// Names in a scene, to check what refers to them.
struct SceneNames {
  std::set<std::string> bodies;
  struct Joint {
    std::string kind, coordinates;  // coordinates offered, separated by spaces
  };
  std::map<std::string, Joint> joints;
  std::map<std::string, std::string> input_owners;  // input name -> kind of load that takes it

  void body(const Check& c, const std::string& name, bool ground_allowed = false) const {
    if (ground_allowed && name == kGround) return;
    if (bodies.count(name) == 0) c.fail("there is no body '" + name + "'; add it first");
  }
  void coordinate(const Check& c, const CoordinateDescription& d) const;
  /// Claims an input name; two loads cannot take the same.
  void input(const Check& c, const std::string& kind, const std::string& name);
};

}  // namespace seacrane
