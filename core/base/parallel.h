// Independent pieces of one computation on all processors.
#ifndef DHCAL_CORE_BASE_PARALLEL_H_
#define DHCAL_CORE_BASE_PARALLEL_H_

#include <functional>

namespace dhcal {

/// Calls work(k) once for each k in [0, count), in any order and on as many threads as there are
/// processors; returns when all are done. Each piece writes to its own place only, so that the
/// outcome does not depend on the number of processors. `work` must not throw.
void ParallelFor(int count, const std::function<void(int)>& work);

}  // namespace dhcal

#endif  // DHCAL_CORE_BASE_PARALLEL_H_
