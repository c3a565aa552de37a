#include "problems/without_rows.h"

#include <map>

namespace dhcal {
namespace {

bool SharesPoses(const Calibration& c) {
  return c.measurement->kind().pairs && c.spec.measurement.noise == NoiseKind::kSharedPose;
}

}  // namespace

std::vector<Reading> WithoutRows(const Calibration& c,
                                 const std::vector<Reading>& readings,
                                 const std::set<int>& rows) {
  const bool shared = SharesPoses(c);
  const bool may_lead_over = shared && c.recording.displacement.rows() == 0;
  std::map<int, int> before;
  for (const Reading& reading : readings) before[reading.row_idx] = reading.previous_idx;
  std::vector<Reading> left;
  for (Reading reading : readings) {
    if (rows.count(reading.row_idx) > 0) continue;
    const bool anchored = reading.previous_idx < 0;
    while (may_lead_over && rows.count(reading.previous_idx) > 0) {
      const auto earlier = before.find(reading.previous_idx);
      reading.previous_idx = earlier == before.end() ? -1 : earlier->second;
    }
    // A difference by itself says nothing of the pose that it starts from.
    if (shared && !anchored && (reading.previous_idx < 0 || rows.count(reading.previous_idx) > 0))
      continue;
    left.push_back(reading);
  }
  return left;
}

}  // namespace dhcal
