// Independent pieces of one computation on all processors.
#ifndef DHCAL_CORE_BASE_PARALLEL_H_
#define DHCAL_CORE_BASE_PARALLEL_H_

#include <functional>

namespace dhcal {

/// At least one.
int NumProcessors();

/// Calls work(k) once for each k in [0, count), in any order and on so many threads; returns when
/// all are done. Each piece writes to its own place only, so that the outcome does not depend on
/// the number of threads. `work` must not throw.
void ParallelFor(int count, const std::function<void(int)>& work, int threads = NumProcessors());

}  // namespace dhcal

#endif  // DHCAL_CORE_BASE_PARALLEL_H_
