#include "tools/proof/simulator/random/random_recording.h"

#include <cmath>

#include <fmt/format.h>

#include "core/base/units.h"
#include "core/io/csv_text.h"
#include "tools/proof/simulator/random/poses.h"
#include "tools/proof/simulator/random/random_readings.h"

namespace dhcal::concealed {
namespace {

using Eigen::Index;

bool Slides(const RandomTrial& trial, Index joint) {
  return trial.drawing.links[static_cast<std::size_t>(joint)].slides;
}

bool HasSpeeds(const RandomTrial& trial) { return trial.motion.speed.rows() > 0; }

void Header(const RandomTrial& trial, CsvText* csv) {
  const Settings& s = trial.settings;
  const Index n = trial.motion.q.cols();
  for (Index j = 0; j < n; ++j) {
    csv->Label(fmt::format("q{}_{}", j + 1, Slides(trial, j) ? "mm" : "deg"));
  }
  if (s.kind == Kind::kDistance) {
    csv->Label("anchor");
    csv->Label("distance_mm");
  } else {
    const bool differences = s.kind == Kind::kAdjacent && !s.shared_pose;
    for (const char axis : {'x', 'y', 'z'}) {
      csv->Label(fmt::format("{}{}_mm", differences ? "d" : "", axis));
    }
  }
  for (const char axis : {'w', 'x', 'y', 'z'}) {
    if (s.kind == Kind::kPose) csv->Label(fmt::format("q{}", axis));
  }
  if (s.clock) csv->Label("t_s");
  if (s.runs > 1) csv->Label("run");
  if (s.targets > 1) csv->Label("target");
  if (s.payload_varies) csv->Label("payload_kg");
  for (Index j = 0; s.directions && j < n; ++j) csv->Label(fmt::format("dir{}", j + 1));
  for (Index j = 0; HasSpeeds(trial) && j < n; ++j) {
    csv->Label(fmt::format("qd{}_{}", j + 1, Slides(trial, j) ? "mm_s" : "deg_s"));
  }
  for (const RecordedColumn& column : trial.columns) csv->Label(column.name);
  if (s.test_rows) csv->Label("set");
  csv->EndRow();
}

void Coordinates(const RandomTrial& trial, Index row, CsvText* csv) {
  for (Index j = 0; j < trial.motion.q.cols(); ++j) {
    const double unit = Slides(trial, j) ? kMillimetre : kDegree;
    csv->Label(fmt::format("{:.{}f}", trial.motion.q(row, j) / unit, trial.settings.decimals));
  }
}

void Reading(const RandomTrial& trial, const Eigen::MatrixXd& readings, Index row, CsvText* csv) {
  if (trial.settings.kind == Kind::kDistance) {
    csv->Label(LetterOf(trial.anchor[static_cast<std::size_t>(row)]));
  }
  for (Index k = 0; k < readings.cols(); ++k) {
    const double value = readings(row, k);
    if (!std::isfinite(value)) {
      csv->Blank();
    } else if (k < 3) {
      csv->Label(fmt::format("{:.4f}", value / kMillimetre));
    } else {
      csv->Label(fmt::format("{:.9f}", value));
    }
  }
}

}  // namespace

std::string LetterOf(int idx) { return {static_cast<char>('A' + idx)}; }

std::string RandomRecordingCsv(const RandomTrial& trial) {
  const Settings& s = trial.settings;
  const Motion& motion = trial.motion;
  const Eigen::MatrixXd readings = RandomReadings(trial);
  const Eigen::MatrixXi directions = Directions(motion);
  CsvText csv;
  Header(trial, &csv);
  for (Index row = 0; row < motion.num_poses(); ++row) {
    const auto i = static_cast<std::size_t>(row);
    Coordinates(trial, row, &csv);
    Reading(trial, readings, row, &csv);
    if (s.clock) csv.Number(motion.time[row]);
    if (s.runs > 1) csv.Label(fmt::format("r{}", motion.run[i]));
    if (s.targets > 1) csv.Label(LetterOf(motion.target[i]));
    if (s.payload_varies) csv.Number(motion.payload[row]);
    for (Index j = 0; s.directions && j < directions.cols(); ++j) {
      csv.Integer(directions(row, j));
    }
    for (Index j = 0; HasSpeeds(trial) && j < motion.speed.cols(); ++j) {
      csv.Number(motion.speed(row, j) / (Slides(trial, j) ? kMillimetre : kDegree));
    }
    for (const RecordedColumn& column : trial.columns) {
      csv.Label(fmt::format("{:.{}f}", column.read[row], column.decimals));
    }
    if (s.test_rows) csv.Label(motion.test[i] ? "test" : "train");
    csv.EndRow();
  }
  return csv.Take();
}

}  // namespace dhcal::concealed
