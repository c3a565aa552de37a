// What is told of the readings of a run.
#ifndef DHCAL_TOOLS_CAMERA_TABLES_H_
#define DHCAL_TOOLS_CAMERA_TABLES_H_

#include <string>
#include <vector>

#include "core/base/diagnostics.h"
#include "tools/camera/rulings.h"
#include "tools/camera/run.h"

namespace dhcal {

/// Warns of what is odd about readings that are good.
void Remark(const RulerCommand& command,
            const std::vector<RulerReading>& found,
            Diagnostics* diagnostics);

/// The table of --details; `ruler` [mm] is NaN where there is no reading, `pitch` [mm].
std::string DetailsText(const RulerCommand& command,
                        const std::vector<RulerReading>& found,
                        const std::vector<double>& ruler,
                        double pitch);

/// One line: how many were read, and how well. At least one was.
std::string Summary(const std::vector<RulerReading>& found,
                    const std::vector<double>& ruler,
                    double pitch);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_CAMERA_TABLES_H_
