#include "residuals/reading_rows.h"

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include <glog/logging.h>

namespace dhcal {
namespace {

constexpr std::size_t kTilePoses = PoseTile::kPoses;
// Enough tiles that a thread's share is worth starting, few enough that two threads share evenly.
constexpr int kStretchTiles = 64;

using Eigen::Index;
using Eigen::VectorXd;

}  // namespace

/// What evaluating tiles of a scope needs, made once per stretch.
struct ReadingRows::Workspace {
  int scope = -1;
  PoseTileScope constants;
  std::unique_ptr<PoseTile> tile;
  std::vector<simd::AlignedDoubles> amounts;  // per slot that effects move, one per pose
  std::vector<SeenPose> seen;
  Eigen::MatrixXd by_now, by_before;  // readings x (coordinates * 6), over sigma where that whitens
};

void TileRows::Resize(Index rows, Index cols) {
  constexpr Index kPack = simd::kLanes;
  num_rows_ = rows;
  num_cols_ = cols;
  stride_ = (rows + kPack - 1) / kPack * kPack;
  values_.resize(static_cast<std::size_t>(stride_ * cols));
}

ReadingRows::ReadingRows(ReadingModel model) : model_(std::move(model)) {
  for (const Scope& scope : model_.scopes) {
    CHECK_EQ(scope.parameters.size(), scope.slots.size());
  }
  std::set<int> moved;
  for (const EffectTerm& term : model_.effects) moved.insert(term.slot);
  for (const HeldTerm& term : model_.held) moved.insert(term.slot);
  effect_slots_.assign(moved.begin(), moved.end());
  MakeKernels();
  PlanTiles();
}

void ReadingRows::MakeKernels() {
  const int num_slots = SlotLayout(model_.robot->num_joints()).size();
  for (const Scope& scope : model_.scopes) {
    ScopeKernel of_scope;
    of_scope.column_of_slot.assign(static_cast<std::size_t>(num_slots), -1);
    std::vector<int> slots = scope.slots;
    for (const EffectTerm& term : model_.effects) {
      if (std::find(slots.begin(), slots.end(), term.slot) == slots.end()) {
        slots.push_back(term.slot);
      }
    }
    for (std::size_t k = 0; k < slots.size(); ++k) {
      if (slots[k] < 0) continue;
      of_scope.column_of_slot[static_cast<std::size_t>(slots[k])] = static_cast<int>(k);
    }
    of_scope.kernel = std::make_unique<PoseTileKernel>(
        *model_.robot, std::move(slots), model_.measurement->kind().turns_show());
    kernels_.push_back(std::move(of_scope));
  }
}

void ReadingRows::CloseTile(Tile* tile) {
  if (tile->readings.empty()) return;
  const bool alone = tile->before[0] < 0;
  for (std::size_t i = 0; i < tile->readings.size(); ++i) {
    tile->contiguous = tile->contiguous && tile->now[i] == tile->now[0] + static_cast<int>(i) &&
                       tile->before[i] == (alone ? -1 : tile->now[i] - 1);
  }
  const PoseTileKernel& kernel = *kernels_[static_cast<std::size_t>(tile->scope)].kernel;
  Eigen::MatrixXd q(model_.recording->q.cols(), static_cast<Index>(tile->rows.size()));
  for (Index i = 0; i < q.cols(); ++i) {
    q.col(i) = model_.recording->q.row(tile->rows[static_cast<std::size_t>(i)]);
  }
  tile->coordinates.resize(static_cast<std::size_t>(kernel.num_coordinates()));
  kernel.FillCoordinates(q, tile->coordinates.data());
  tiles_.push_back(std::move(*tile));
  *tile = Tile();
}

void ReadingRows::PlanTiles() {
  std::vector<Tile> open(model_.scopes.size());
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
    const std::size_t new_poses = reading.previous_idx < 0 ? 1 : 2;
    if (tile->rows.size() + new_poses > kTilePoses) CloseTile(tile);
    tile->scope = scope;
    tile->readings.push_back(k);
    tile->before.push_back(reading.previous_idx < 0 ? -1 : pose_of(tile, reading.previous_idx));
    tile->now.push_back(pose_of(tile, reading.row_idx));
  }
  for (Tile& tile : open) CloseTile(&tile);
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
  VectorXd delta = VectorXd::Zero(SlotLayout(model_.robot->num_joints()).size());
  for (std::size_t k = 0; k < scope.slots.size(); ++k) {
    if (scope.slots[k] >= 0) delta[scope.slots[k]] += x[scope.parameters[k]];
  }
  return delta;
}

void ReadingRows::EvaluatePoses(const Tile& tile, const VectorXd& x, Workspace* work) const {
  const ScopeKernel& of_scope = kernels_[static_cast<std::size_t>(tile.scope)];
  const Scope& scope = model_.scopes[static_cast<std::size_t>(tile.scope)];
  if (work->scope != tile.scope) {
    work->scope = tile.scope;
    work->constants = of_scope.kernel->Prepare(scope.ends, ScopeDeltas(tile.scope, x));
    work->tile = std::make_unique<PoseTile>(of_scope.kernel->MakeTile());
  }
  // Unused poses of the tile repeat the last one; so do its amounts.
  const auto at_pose = [&](const VectorXd& of_row, std::size_t pose) {
    return of_row[tile.rows[std::min(pose, tile.rows.size() - 1)]];
  };
  PoseTileInput input{&work->constants, tile.coordinates.data(), {}};
  work->amounts.resize(effect_slots_.size());
  for (std::size_t s = 0; s < effect_slots_.size(); ++s) {
    work->amounts[s].assign(kTilePoses, 0.0);
    for (std::size_t pose = 0; pose < kTilePoses; ++pose) {
      double& amount = work->amounts[s][pose];
      for (const HeldTerm& term : model_.held) {
        if (term.slot == effect_slots_[s]) amount += at_pose(*term.amount, pose);
      }
      for (const EffectTerm& term : model_.effects) {
        if (term.slot == effect_slots_[s])
          amount += at_pose(*term.weight, pose) * x[term.parameter];
      }
    }
    input.amounts.push_back({effect_slots_[s], work->amounts[s].data()});
  }
  of_scope.kernel->Evaluate(input, work->tile.get());

  // The twist of an effect's parameter is that of the slots that it moves, weighted.
  auto twist = work->tile->J();
  const Index blocks = work->tile->num_rows() / PoseTile::kPoses;
  std::vector<int> column_of_parameter(static_cast<std::size_t>(model_.num_unknowns), -1);
  for (std::size_t k = 0; k < scope.slots.size(); ++k) {
    column_of_parameter[static_cast<std::size_t>(scope.parameters[k])] = static_cast<int>(k);
    if (scope.slots[k] < 0) twist.col(static_cast<Index>(k)).setZero();
  }
  Eigen::Array<double, PoseTile::kPoses, 1> weight;
  for (const EffectTerm& term : model_.effects) {
    const int column = column_of_parameter[static_cast<std::size_t>(term.parameter)];
    if (column < 0) continue;
    for (std::size_t pose = 0; pose < kTilePoses; ++pose) {
      weight[static_cast<Index>(pose)] = at_pose(*term.weight, pose);
    }
    const int from = of_scope.column_of_slot[static_cast<std::size_t>(term.slot)];
    for (Index b = 0; b < blocks; ++b) {
      twist.col(column).segment<PoseTile::kPoses>(b * PoseTile::kPoses).array() +=
          weight * twist.col(from).segment<PoseTile::kPoses>(b * PoseTile::kPoses).array();
    }
  }

  const bool turns = model_.measurement->kind().turns_show();
  work->seen.resize(tile.rows.size());
  for (std::size_t i = 0; i < tile.rows.size(); ++i) {
    const auto pose = static_cast<Index>(i);
    work->seen[i].p_WQ = work->tile->p_WQ().row(pose);
    if (turns) work->seen[i].R_WQ = work->tile->R_WQ(static_cast<int>(i));
  }
}

bool ReadingRows::Compare(const Tile& tile,
                          const RowNoise& noise,
                          Workspace* work,
                          TileRows* rows) const {
  const auto count = static_cast<Index>(tile.readings.size());
  const std::vector<MeasuredCoordinate>& coordinates = model_.measurement->kind().coordinates;
  const auto num_coordinates = static_cast<Index>(coordinates.size());
  rows->readings = tile.readings;
  rows->Resize(num_coordinates * count, num_unknowns() + 1);
  work->by_now.setZero(count, num_coordinates * 6);
  work->by_before.setZero(count, num_coordinates * 6);
  auto r = rows->r();
  const bool pairs = tile.before[0] >= 0 || !tile.contiguous;
  // Kinds write the same entries for every reading, the others stay zero.
  ReadingComparison comparison(static_cast<int>(num_coordinates));
  for (Index i = 0; i < count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Reading& reading = model_.readings[static_cast<std::size_t>(tile.readings[k])];
    const SeenPose& now = work->seen[static_cast<std::size_t>(tile.now[k])];
    const SeenPose* const before =
        tile.before[k] >= 0 ? &work->seen[static_cast<std::size_t>(tile.before[k])] : nullptr;
    if (!model_.measurement->Compare(reading, now, before, &comparison)) return false;
    const double by_length = noise.shared ? 1 : 1 / noise.sigma[reading.row_idx];
    for (Index c = 0; c < num_coordinates; ++c) {
      const bool length = coordinates[static_cast<std::size_t>(c)].unit == Unit::kMetre;
      const double over_sigma = (length ? by_length : 1 / noise.sigma_rotation) /
                                coordinates[static_cast<std::size_t>(c)].noise;
      r[c * count + i] = over_sigma * comparison.difference[c];
      work->by_now.row(i).segment<6>(c * 6) = over_sigma * comparison.by_now.row(c);
      if (pairs)
        work->by_before.row(i).segment<6>(c * 6) = over_sigma * comparison.by_before.row(c);
    }
  }
  AddTwists(tile, pairs, *work, rows);
  // What is not finite in J comes from a pose that is not, and that shows in r.
  return rows->r().allFinite();
}

void ReadingRows::AddTwists(const Tile& tile,
                            bool pairs,
                            const Workspace& work,
                            TileRows* rows) const {
  const auto count = static_cast<Index>(tile.readings.size());
  const Index num_coordinates = rows->rows().rows() / count;
  const Scope& scope = model_.scopes[static_cast<std::size_t>(tile.scope)];
  const auto twist = std::as_const(*work.tile).J();
  auto J = rows->J();
  const bool all = static_cast<int>(scope.parameters.size()) == num_unknowns();
  if (!all) J.setZero();
  const auto add = [&](const Eigen::MatrixXd& weights,
                       const std::vector<int>& of,
                       Index coordinate,
                       Index component,
                       bool first) {
    const auto weight = weights.col(coordinate * 6 + component).array();
    if (!first && (weight == 0).all()) return;
    for (std::size_t k = 0; k < scope.parameters.size(); ++k) {
      auto out = J.col(scope.parameters[k]).segment(coordinate * count, count).array();
      const auto column =
          twist.col(static_cast<Index>(k)).segment<PoseTile::kPoses>(component * PoseTile::kPoses);
      if (tile.contiguous && first) {
        out = weight * column.segment(of[0], count).array();
      } else if (tile.contiguous) {
        out += weight * column.segment(of[0], count).array();
      } else {
        if (first) out.setZero();
        for (Index i = 0; i < count; ++i) {
          const int at = of[static_cast<std::size_t>(i)];
          if (at >= 0) out[i] += weight[i] * column[at];
        }
      }
    }
  };
  const Index components = model_.measurement->kind().turns_show() ? 6 : 3;
  for (Index coordinate = 0; coordinate < num_coordinates; ++coordinate) {
    for (Index component = 0; component < components; ++component) {
      add(work.by_now, tile.now, coordinate, component, component == 0);
      if (pairs) add(work.by_before, tile.before, coordinate, component, false);
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
      pair.row(c) = rows->rows().row(c * count + i);
    }
    series->at(reading.row_idx).Whiten(noise.sigma[reading.row_idx], pair);
    for (int c = 0; c < coordinates; ++c) {
      rows->rows().row(c * count + i) = pair.row(c);
    }
  }
}

bool ReadingRows::Visit(const VectorXd& x,
                        const RowNoise& noise,
                        std::pair<int, int> stretch,
                        const std::function<void(const TileRows&)>& visit) const {
  CHECK_EQ(x.size(), model_.num_unknowns);
  Workspace work;
  TileRows rows;
  OpenSeries series;
  for (int k = stretch.first; k < stretch.second; ++k) {
    const Tile& tile = tiles_[static_cast<std::size_t>(k)];
    EvaluatePoses(tile, x, &work);
    if (!Compare(tile, noise, &work, &rows)) return false;
    if (noise.shared) WhitenSeries(noise, tile, &series, &rows);
    visit(rows);
  }
  return true;
}

void ReadingRows::VisitPoses(
    const VectorXd& x,
    const std::function<void(int reading, const SeenPose& now, const SeenPose* before)>& visit)
    const {
  Workspace work;
  for (const Tile& tile : tiles_) {
    EvaluatePoses(tile, x, &work);
    for (std::size_t i = 0; i < tile.readings.size(); ++i) {
      const SeenPose* const before =
          tile.before[i] >= 0 ? &work.seen[static_cast<std::size_t>(tile.before[i])] : nullptr;
      visit(tile.readings[i], work.seen[static_cast<std::size_t>(tile.now[i])], before);
    }
  }
}

}  // namespace dhcal
