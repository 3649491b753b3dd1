#include "seacrane/dynamics/recursive/tree_branches.hpp"

namespace seacrane {

template class TreeKinematics<double>;
template class ArticulatedTree<double>;

}  // namespace seacrane
