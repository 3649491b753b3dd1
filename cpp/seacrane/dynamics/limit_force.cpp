#include "seacrane/dynamics/limit_force.hpp"

namespace seacrane {

double limit_force(const Limit& limit, const Terms& terms, const double* lambda) {
  const double* own = lambda + terms.model().elements[idx(limit.element)].row;
  if (limit.kind->closes_again) return limit.side * *own;
  const JointData& joint = limit.coordinate.joint;
  const Vec3d normal = terms.bodies()[idx(joint.first)].rotation * joint.first_axes.col(2);
  return normal.dot(view<3>(own));
}

}  // namespace seacrane
