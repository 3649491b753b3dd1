#include "seacrane/dynamics/recursive/articulated.hpp"

namespace seacrane {

template class ArticulatedTree<double>;

}  // namespace seacrane
