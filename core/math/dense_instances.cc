#include "core/math/dense_instances.h"

namespace Eigen {

DHCAL_DENSE_INSTANCES(template)

}  // namespace Eigen
