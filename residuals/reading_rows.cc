#include "residuals/reading_rows.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include <glog/logging.h>

namespace dhcal {
namespace {

constexpr std::size_t kTilePoses = 64;
// Enough tiles that a thread's share is worth starting, few enough that two threads share evenly.
constexpr int kStretchTiles = 64;

using Eigen::Index;
using Eigen::VectorXd;

/// dh/d twist of all readings of a tile: one column of readings per coordinate and component.
struct TwistDerivative {
  TwistDerivative(Index coordinates, Index readings)
      : values(Eigen::MatrixXd::Zero(readings, coordinates * 6)) {}
  auto of(Index coordinate, Index component) { return values.col(coordinate * 6 + component); }
  Eigen::MatrixXd values;
};

}  // namespace

/// Twists are stored component by component: rows [c * poses, (c + 1) * poses) of a column are
/// component c of all poses.
struct ReadingRows::TilePoses {
  std::vector<SeenPose> seen;
  Eigen::MatrixXd twist;  // 6 poses x parameters of the scope
};

ReadingRows::ReadingRows(ReadingModel model) : model_(std::move(model)) {
  for (const Scope& scope : model_.scopes) {
    CHECK_EQ(scope.parameters.size(), scope.slots.size());
  }
  PlanTiles();
}

void ReadingRows::PlanTiles() {
  std::vector<Tile> open(model_.scopes.size());
  const auto close = [&](Tile* tile) {
    if (tile->readings.empty()) return;
    for (std::size_t i = 0; i < tile->readings.size(); ++i) {
      const bool alone = tile->before[0] < 0;
      tile->contiguous = tile->contiguous && tile->now[i] == tile->now[0] + static_cast<int>(i) &&
                         tile->before[i] == (alone ? -1 : tile->now[i] - 1);
    }
    tiles_.push_back(std::move(*tile));
    *tile = Tile();
  };
  const auto pose_of = [](Tile* tile, int row_idx) {
    // Poses of neighbouring readings stand at the end.
    const auto found = std::find(tile->rows.rbegin(), tile->rows.rend(), row_idx);
    if (found != tile->rows.rend()) return static_cast<int>(tile->rows.rend() - found) - 1;
    tile->rows.push_back(row_idx);
    return static_cast<int>(tile->rows.size()) - 1;
  };
  for (int k = 0; k < num_readings(); ++k) {
    const Reading& reading = model_.readings[static_cast<std::size_t>(k)];
    const int scope = model_.scope_of_row[static_cast<std::size_t>(reading.row_idx)];
    Tile* const tile = &open[static_cast<std::size_t>(scope)];
    if (tile->rows.size() + 2 > kTilePoses) close(tile);
    tile->scope = scope;
    tile->readings.push_back(k);
    tile->before.push_back(reading.previous_idx < 0 ? -1 : pose_of(tile, reading.previous_idx));
    tile->now.push_back(pose_of(tile, reading.row_idx));
  }
  for (Tile& tile : open) close(&tile);
}

std::vector<std::pair<int, int>> ReadingRows::Stretches(bool shared) const {
  std::vector<std::pair<int, int>> stretches;
  const int length = shared ? std::max(num_tiles(), 1) : kStretchTiles;
  for (int first = 0; first < num_tiles(); first += length) {
    stretches.emplace_back(first, std::min(first + length, num_tiles()));
  }
  return stretches;
}

VectorXd ReadingRows::ScopeDeltas(int scope_idx, const VectorXd& x) const {
  const Scope& scope = model_.scopes[static_cast<std::size_t>(scope_idx)];
  VectorXd delta = VectorXd::Zero(model_.chain->slots().size());
  for (std::size_t k = 0; k < scope.slots.size(); ++k) {
    if (scope.slots[k] >= 0) delta[scope.slots[k]] += x[scope.parameters[k]];
  }
  return delta;
}

void ReadingRows::EvaluatePoses(const Tile& tile, const VectorXd& x, TilePoses* poses) const {
  const Scope& scope = model_.scopes[static_cast<std::size_t>(tile.scope)];
  const auto num_poses = static_cast<Index>(tile.rows.size());
  const VectorXd of_scope = ScopeDeltas(tile.scope, x);
  poses->seen.resize(tile.rows.size());
  poses->twist.setZero(6 * num_poses, static_cast<Index>(scope.parameters.size()));
  std::map<int, Index> column_of;  // effect parameter -> column
  for (std::size_t k = 0; k < scope.slots.size(); ++k) {
    if (scope.slots[k] < 0) column_of[scope.parameters[k]] = static_cast<Index>(k);
  }
  PoseWithDerivatives pose;
  for (Index i = 0; i < num_poses; ++i) {
    const int row_idx = tile.rows[static_cast<std::size_t>(i)];
    VectorXd delta = of_scope;
    for (const HeldTerm& term : model_.held) delta[term.slot] += (*term.amount)[row_idx];
    for (const EffectTerm& term : model_.effects) {
      delta[term.slot] += (*term.weight)[row_idx] * x[term.parameter];
    }
    model_.chain->PoseAndDerivatives(
        model_.recording->q.row(row_idx).transpose(), delta, scope.ends, &pose);
    poses->seen[static_cast<std::size_t>(i)] = {pose.p_WQ, pose.R_WQ};
    const auto add = [&](Index column, int slot, double weight) {
      for (Index c = 0; c < 3; ++c) {
        poses->twist(c * num_poses + i, column) += weight * pose.J_p(c, slot);
        poses->twist((3 + c) * num_poses + i, column) += weight * pose.J_w(c, slot);
      }
    };
    for (std::size_t k = 0; k < scope.slots.size(); ++k) {
      if (scope.slots[k] >= 0) add(static_cast<Index>(k), scope.slots[k], 1);
    }
    for (const EffectTerm& term : model_.effects) {
      add(column_of.at(term.parameter), term.slot, (*term.weight)[row_idx]);
    }
  }
}

bool ReadingRows::Compare(const Tile& tile, const TilePoses& poses, TileRows* rows) const {
  const Scope& scope = model_.scopes[static_cast<std::size_t>(tile.scope)];
  const auto count = static_cast<Index>(tile.readings.size());
  const auto num_poses = static_cast<Index>(tile.rows.size());
  const Index coordinates = num_coordinates();
  TwistDerivative by_now(coordinates, count), by_before(coordinates, count);
  rows->readings = tile.readings;
  rows->r.resize(coordinates * count);
  for (Index i = 0; i < count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const bool pair = tile.before[k] >= 0;
    ReadingComparison comparison(static_cast<int>(coordinates));
    const Reading& reading = model_.readings[static_cast<std::size_t>(tile.readings[k])];
    const SeenPose& now = poses.seen[static_cast<std::size_t>(tile.now[k])];
    const SeenPose* const before =
        pair ? &poses.seen[static_cast<std::size_t>(tile.before[k])] : nullptr;
    if (!model_.measurement->Compare(reading, now, before, &comparison)) return false;
    for (Index c = 0; c < coordinates; ++c) {
      rows->r[c * count + i] = comparison.difference[c];
      by_now.values.row(i).segment<6>(c * 6) = comparison.by_now.row(c);
      by_before.values.row(i).segment<6>(c * 6) = comparison.by_before.row(c);
    }
  }
  rows->J.setZero(coordinates * count, model_.num_unknowns);
  const bool pairs = tile.before[0] >= 0 || !tile.contiguous;
  const auto add = [&](TwistDerivative* derivative,
                       const std::vector<int>& of,
                       Index coordinate,
                       Index component) {
    const auto weight = derivative->of(coordinate, component);
    if ((weight.array() == 0).all()) return;
    for (std::size_t k = 0; k < scope.parameters.size(); ++k) {
      auto out = rows->J.col(scope.parameters[k]).segment(coordinate * count, count);
      const auto twist =
          poses.twist.col(static_cast<Index>(k)).segment(component * num_poses, num_poses);
      if (tile.contiguous) {
        out.array() += weight.array() * twist.segment(of[0], count).array();
        continue;
      }
      for (Index i = 0; i < count; ++i) {
        const int at = of[static_cast<std::size_t>(i)];
        if (at >= 0) out[i] += weight[i] * twist[at];
      }
    }
  };
  for (Index coordinate = 0; coordinate < coordinates; ++coordinate) {
    for (Index component = 0; component < 6; ++component) {
      add(&by_now, tile.now, coordinate, component);
      if (pairs) add(&by_before, tile.before, coordinate, component);
    }
  }
  return rows->r.allFinite() && rows->J.allFinite();
}

void ReadingRows::Whiten(const RowNoise& noise, const Tile& tile, TileRows* rows) const {
  const auto count = static_cast<Index>(tile.readings.size());
  const std::vector<MeasuredCoordinate>& coordinates = model_.measurement->kind().coordinates;
  VectorXd inverse_sigma(count);
  for (Index i = 0; i < count; ++i) {
    const int row_idx = tile.rows[static_cast<std::size_t>(tile.now[static_cast<std::size_t>(i)])];
    inverse_sigma[i] = 1 / noise.sigma[row_idx];
  }
  for (std::size_t c = 0; c < coordinates.size(); ++c) {
    const Index first = static_cast<Index>(c) * count;
    if (coordinates[c].unit == Unit::kMetre) {
      rows->J.middleRows(first, count).array().colwise() *= inverse_sigma.array();
      rows->r.segment(first, count).array() *= inverse_sigma.array();
    } else {
      rows->J.middleRows(first, count) /= noise.sigma_rotation;
      rows->r.segment(first, count) /= noise.sigma_rotation;
    }
  }
}

void ReadingRows::WhitenSeries(const RowNoise& noise,
                               const Tile& tile,
                               OpenSeries* series,
                               TileRows* rows) const {
  const auto count = static_cast<Index>(tile.readings.size());
  const int coordinates = num_coordinates();
  Eigen::MatrixXd pair(coordinates, num_unknowns() + 1);
  for (Index i = 0; i < count; ++i) {
    const Reading& reading =
        model_.readings[static_cast<std::size_t>(tile.readings[static_cast<std::size_t>(i)])];
    auto found = series->extract(reading.previous_idx);
    if (found.empty()) {
      const bool anchored = reading.previous_idx < 0;
      const SeriesWhitener fresh =
          anchored
              ? SeriesWhitener(coordinates, num_unknowns() + 1)
              : SeriesWhitener(coordinates, num_unknowns() + 1, noise.sigma[reading.previous_idx]);
      series->emplace(reading.row_idx, fresh);
    } else {
      found.key() = reading.row_idx;
      series->insert(std::move(found));
    }
    for (int c = 0; c < coordinates; ++c) {
      pair.row(c) << rows->J.row(c * count + i), rows->r[c * count + i];
    }
    series->at(reading.row_idx).Whiten(noise.sigma[reading.row_idx], pair);
    for (int c = 0; c < coordinates; ++c) {
      rows->J.row(c * count + i) = pair.row(c).head(num_unknowns());
      rows->r[c * count + i] = pair(c, num_unknowns());
    }
  }
}

bool ReadingRows::Visit(const VectorXd& x,
                        const RowNoise& noise,
                        std::pair<int, int> stretch,
                        const std::function<void(const TileRows&)>& visit) const {
  CHECK_EQ(x.size(), model_.num_unknowns);
  TilePoses poses;
  TileRows rows;
  OpenSeries series;
  for (int k = stretch.first; k < stretch.second; ++k) {
    const Tile& tile = tiles_[static_cast<std::size_t>(k)];
    EvaluatePoses(tile, x, &poses);
    if (!Compare(tile, poses, &rows)) return false;
    if (noise.shared) {
      WhitenSeries(noise, tile, &series, &rows);
    } else {
      Whiten(noise, tile, &rows);
    }
    visit(rows);
  }
  return true;
}

}  // namespace dhcal
