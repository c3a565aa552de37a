#include "residuals/readings.h"

#include <map>
#include <tuple>

namespace dhcal {
namespace {

Readings CollectPairs(const Measurement& measurement, const Recording& recording, bool anchored) {
  Readings readings;
  const auto add = [&](const Reading& reading, bool test) {
    (test ? readings.test : readings.fitted).push_back(reading);
  };
  // The latest row of each run, target and edge that a later one may be paired with.
  std::map<std::tuple<int, int, int>, int> latest;
  for (int row_idx = 0; row_idx < recording.num_rows(); ++row_idx) {
    if (!measurement.CanPrecede(row_idx)) continue;
    const auto series =
        std::make_tuple(recording.run(row_idx), recording.target(row_idx), recording.edge(row_idx));
    const auto before = latest.find(series);
    if (before == latest.end()) {
      const bool known = recording.p_WQ.rows() > 0 && recording.p_WQ.row(row_idx).allFinite();
      if (anchored && known) add({row_idx, -1}, recording.test(row_idx));
    } else if (measurement.HasReading(row_idx)) {
      add({row_idx, before->second}, recording.test(row_idx) || recording.test(before->second));
    }
    latest[series] = row_idx;
  }
  return readings;
}

}  // namespace

Readings CollectReadings(const Measurement& measurement,
                         const Recording& recording,
                         bool anchored) {
  if (measurement.kind().pairs) return CollectPairs(measurement, recording, anchored);
  Readings readings;
  for (int row_idx = 0; row_idx < recording.num_rows(); ++row_idx) {
    if (!measurement.HasReading(row_idx)) continue;
    (recording.test(row_idx) ? readings.test : readings.fitted).push_back({row_idx, -1});
  }
  return readings;
}

}  // namespace dhcal
