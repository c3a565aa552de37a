// What is odd about rows that were set aside: most misreadings have a cause that shows.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_ROWS_ODDITIES_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_ROWS_ODDITIES_H_

#include <vector>

#include "core/model/recording.h"
#include "core/model/result.h"

namespace dhcal {

/// One entry per row of `rows`, in their order; writes the reason into their residuals, too.
std::vector<RowSetAside> DescribeSetAside(const Recording& recording,
                                          const std::vector<int>& rows,
                                          std::vector<RowResidual>* residuals);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_ROWS_ODDITIES_H_
