#include "problems/diagnosis/clean_rows.h"

#include <algorithm>
#include <map>

#include "problems/diagnosis/projection.h"

namespace dhcal {
namespace {

constexpr int kOutlierRounds = 3;
// Test rows decide nothing but whether a name holds: more of them may be misread before it is the
// model that is wrong.
constexpr double kMostMisread = 0.2;   // of all readings
constexpr double kMissedAsWell = 0.5;  // of what the effects miss a row by, by the geometry alone

bool SharesPoses(const Calibration& c) {
  return c.measurement->kind().pairs && c.spec.measurement.noise == NoiseKind::kSharedPose;
}

/// Fitted and test readings in recording order.
std::vector<Reading> AllReadings(const Calibration& c) {
  std::vector<Reading> all = c.readings.fitted;
  all.insert(all.end(), c.readings.test.begin(), c.readings.test.end());
  std::sort(all.begin(), all.end(), [](const Reading& a, const Reading& b) {
    return a.row_idx < b.row_idx;
  });
  return all;
}

}  // namespace

CleanRows TakeOutModel(const CompleteFit& fit, const std::vector<Reading>& readings) {
  CleanRows clean;
  clean.readings = readings;
  clean.rows =
      std::make_unique<DesignRows>(fit.calibration, fit.state(), fit.fit.noise_seen, readings);
  clean.U = ModelBasis(fit, readings);
  clean.y = ProjectOff(clean.U, clean.rows->y());
  clean.nu = static_cast<double>(clean.rows->degrees_of_freedom() - clean.U.cols());
  clean.rms = RmsAsRead(fit.calibration, fit.fit.noise_seen, clean.rows->now_row(), clean.y);
  return clean;
}

double RmsOfReadings(const CompleteFit& fit, const std::vector<Reading>& readings) {
  const Noise& noise = fit.fit.noise_seen;
  const DesignRows rows(fit.calibration, fit.state(), noise, readings);
  return RmsAsRead(fit.calibration, noise, rows.now_row(), rows.y());
}

void WhitenSerially(const CompleteFit& fit, double rho, CleanRows* clean) {
  clean->rows->WhitenSerially(rho);
  clean->U = ModelBasis(fit, clean->readings, rho);
  clean->y = ProjectOff(clean->U, clean->rows->y());
}

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

std::set<int> RowsThatLieOff(const CompleteFit& fit, const std::vector<Reading>& readings) {
  const Calibration& c = fit.calibration;
  std::set<int> off;
  for (int round = 0; round < kOutlierRounds; ++round) {
    const CleanRows clean = TakeOutModel(fit, WithoutRows(c, readings, off));
    OutlierRule rule;
    rule.leverage = clean.rows->OffsetLeverage();
    const std::vector<bool> flagged =
        FlagOutliers(clean.y, clean.U, clean.rows->coordinates(), rule);
    if (FollowAJoint(*clean.rows, clean.y, flagged, c.recording.num_joints())) break;
    const std::size_t known = off.size();
    for (std::size_t k = 0; k < flagged.size(); ++k) {
      if (flagged[k]) off.insert(clean.rows->recording_row(static_cast<int>(k)));
    }
    if (off.size() == known) break;
  }
  return off;
}

std::set<int> MisreadTestRows(const CompleteFit& before, const CompleteFit& after) {
  const Calibration& c = after.calibration;
  if (c.readings.test.empty()) return {};
  std::set<int> test;
  for (const Reading& reading : c.readings.test) test.insert(reading.row_idx);
  const std::vector<Reading> all = AllReadings(c);
  const auto rows_of = [&](const CompleteFit& fit) {
    return DesignRows(fit.calibration, fit.state(), after.fit.noise_seen, all);
  };
  const DesignRows rows = rows_of(after), by_geometry = rows_of(before);
  OutlierRule rule;
  rule.most = kMostMisread;
  rule.leverage = rows.OffsetLeverage();
  const int coordinates = rows.coordinates();
  const std::vector<bool> flagged =
      FlagOutliers(rows.y(), Eigen::MatrixXd(rows.num_rows(), 0), coordinates, rule);
  std::set<int> misread;
  for (std::size_t k = 0; k < flagged.size(); ++k) {
    const int row = rows.recording_row(static_cast<int>(k));
    if (!flagged[k] || test.count(row) == 0) continue;
    const auto first = static_cast<Eigen::Index>(k) * coordinates;
    const double missed = rows.y().segment(first, coordinates).norm();
    const double without = by_geometry.y().segment(first, coordinates).norm();
    if (without > kMissedAsWell * missed) misread.insert(row);
  }
  return misread;
}

}  // namespace dhcal
