#include "problems/plan/plan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include "core/base/rng.h"
#include "core/math/statistics.h"
#include "problems/plan/information.h"
#include "problems/plan/plan_space.h"
#include "problems/start.h"

namespace dhcal {
namespace {

constexpr int kPoses = 100, kPlacements = 12;
constexpr int kPoseCandidates = 1000, kPlacementCandidates = 600;
constexpr int kRandomDraws = 25;
// Counts of the table, in parts of the count asked for.
constexpr double kLadder[] = {0.1, 0.15, 0.25, 0.35, 0.5, 0.7, 1, 1.5, 2};
constexpr int kFewest = 3;
// What a fit leaves is more than noise from here on.
constexpr double kAboveNoise = 1.2;

std::vector<int> Ladder(int count, int candidates) {
  std::set<int> counts;
  for (const double part : kLadder) {
    const auto step = static_cast<int>(std::lround(part * count));
    if (step >= kFewest && step <= candidates) counts.insert(step);
  }
  counts.insert(count);
  return {counts.begin(), counts.end()};
}

/// Mean squares in the region.
class RegionErrors {
 public:
  /// `all`: the information of all candidates together.
  RegionErrors(Eigen::MatrixXd weights, const Eigen::MatrixXd& all)
      : weights_(std::move(weights)), hidden_(weights_.cwiseProduct(UnseenBy(all)).sum()) {}

  const Eigen::MatrixXd& weights() const { return weights_; }
  /// RMS [m] of what no candidate shows.
  double hidden() const { return std::sqrt(std::max(0.0, hidden_)); }
  /// RMS [m] beside it, by a covariance in tolerances.
  double Of(const Eigen::MatrixXd& covariance) const {
    return std::sqrt(std::max(0.0, weights_.cwiseProduct(covariance).sum() - hidden_));
  }
  double OfInformation(const Eigen::MatrixXd& information) const {
    const auto one = Eigen::MatrixXd::Identity(information.rows(), information.cols());
    return Of((one + information).llt().solve(one));
  }

 private:
  Eigen::MatrixXd weights_;
  double hidden_;
};

/// The median over random choices.
double RandomError(const std::vector<Eigen::MatrixXd>& informations,
                   const RegionErrors& errors,
                   int count,
                   Rng* rng) {
  std::vector<double> rms;
  std::vector<std::size_t> order(informations.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  for (int draw = 0; draw < kRandomDraws; ++draw) {
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(errors.weights().rows(), errors.weights().cols());
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
      const double left = static_cast<double>(order.size() - k);
      const auto pick = static_cast<std::size_t>(rng->Uniform(0, left));
      std::swap(order[k], order[std::min(k + pick, order.size() - 1)]);
      sum += informations[order[k]];
    }
    rms.push_back(errors.OfInformation(sum));
  }
  return Median(rms);
}

/// Short ways: from each pose to the nearest that is left.
std::vector<int> InShortWays(const Candidates& candidates, std::vector<int> chosen) {
  std::vector<int> first_row(static_cast<std::size_t>(candidates.count), -1);
  for (std::size_t row = candidates.group_of_row.size(); row-- > 0;) {
    first_row[static_cast<std::size_t>(candidates.group_of_row[row])] = static_cast<int>(row);
  }
  const auto q = [&](int group) {
    return candidates.rows.q.row(first_row[static_cast<std::size_t>(group)]);
  };
  for (std::size_t k = 1; k < chosen.size(); ++k) {
    const auto nearest =
        std::min_element(chosen.begin() + static_cast<long>(k), chosen.end(), [&](int a, int b) {
          return (q(a) - q(chosen[k - 1])).norm() < (q(b) - q(chosen[k - 1])).norm();
        });
    std::swap(chosen[k], *nearest);
  }
  return chosen;
}

Candidates Draw(const ProblemSpec& spec, const PlanOptions& options, Diagnostics* diagnostics) {
  Rng rng(options.seed);
  const bool edges = spec.robot.base_per_edge;
  const int wanted = options.candidates > 0 ? options.candidates
                     : edges                ? kPlacementCandidates
                                            : kPoseCandidates;
  Candidates drawn = edges ? DrawEdges(spec.robot, options.volume, options.edge, wanted, &rng)
                           : DrawPoses(spec.robot, options.volume, wanted, &rng);
  const int count = options.count > 0 ? options.count : edges ? kPlacements : kPoses;
  if (drawn.count < count) {
    diagnostics->Error(
        {spec.file},
        fmt::format("of {} random tries the robot's range has only {} {}, fewer than the {} that "
                    "are to be chosen; widen the volume{}, check 'limits_deg' of the joints, or "
                    "ask for fewer",
                    drawn.tried,
                    drawn.count,
                    edges ? "placements of the edge that the tool can follow"
                          : "poses in the "
                            "volume",
                    count,
                    edges ? ", shorten the edge, tilt the tool less" : ""));
  }
  return drawn;
}

/// What the user's own readings let expect.
PlannedError OwnError(const ProblemSpec& spec,
                      const Recording& own,
                      const Noise& noise,
                      const std::vector<std::string>& names,
                      const RegionErrors& errors) {
  Calibration c(spec, own);
  AlignStart(&c);
  const RowGroups one{std::vector<int>(static_cast<std::size_t>(own.num_rows()), 0), 1};
  PlannedError error;
  error.count = spec.robot.base_per_edge ? static_cast<int>(own.edge_names.size())
                                         : static_cast<int>(c.readings.fitted.size());
  error.rms = errors.OfInformation(InformationOf(c, noise, names, one).front());
  error.rms_random = std::numeric_limits<double>::quiet_NaN();
  return error;
}

/// The groups of the candidates' rows as they are read: on every target.
RowGroups GroupsOf(const Candidates& candidates, int num_rows) {
  const std::size_t times = static_cast<std::size_t>(num_rows) / candidates.group_of_row.size();
  RowGroups groups;
  groups.count = candidates.count;
  for (std::size_t row = 0; row < static_cast<std::size_t>(num_rows); ++row) {
    groups.of_row.push_back(candidates.group_of_row[row / times]);
  }
  return groups;
}

void Conclude(const Noise& noise, double fit_rms, Plan* plan) {
  plan->sigma = noise.sigma;
  plan->floor = std::sqrt(3.0) * noise.sigma;
  plan->floor_from_fit = fit_rms > kAboveNoise * plan->floor;
  if (plan->floor_from_fit) plan->floor = fit_rms;
  for (const PlannedError& error : plan->errors) {
    const bool lost = std::hypot(error.rms, plan->floor) <= (1 + kLostInFloor) * plan->floor;
    if (lost && plan->enough < 0) plan->enough = error.count;
    if (plan->own && error.rms <= plan->own->rms && plan->own_matched_by < 0) {
      plan->own_matched_by = error.count;
    }
  }
}

}  // namespace

std::optional<Plan> PlanPoses(const ProblemSpec& spec,
                              const Recording* own,
                              const PlanOptions& options,
                              Diagnostics* diagnostics) {
  Plan plan;
  ProblemSpec planning = PlanningProblem(spec, &plan.notes);
  double fit_rms = 0;
  const std::optional<Noise> noise = PlanNoise(spec, own, &fit_rms, diagnostics);
  const TaskError region = PlanRegion(spec);
  if (!region.unknown.empty()) diagnostics->Error(spec.task->where, region.unknown);
  const bool edges = spec.robot.base_per_edge;
  const Candidates candidates = Draw(planning, options, diagnostics);
  if (edges && !options.volume) {
    plan.notes.emplace_back(
        "No volume was given: placements may lie where the robot itself or its stand is.");
  }
  if (!diagnostics->ok()) return std::nullopt;
  planning.robot.edges = planning.measurement.edges = candidates.edges;
  const std::optional<Recording> rows = ReadingsAt(planning, candidates.rows, diagnostics);
  if (!rows) return std::nullopt;

  const Calibration c(planning, *rows);
  const std::vector<std::string> names = SharedNames(c);
  const std::vector<Eigen::MatrixXd> informations =
      InformationOf(c, *noise, names, GroupsOf(candidates, rows->num_rows()));
  std::vector<Eigen::MatrixXd> blocks;
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(names.size()),
                                              static_cast<Eigen::Index>(names.size()));
  for (const Eigen::MatrixXd& information : informations) {
    blocks.push_back(RowsOfInformation(information));
    all += information;
  }
  const RegionErrors errors(RegionWeights(c, names, region), all);

  plan.count = options.count > 0 ? options.count : edges ? kPlacements : kPoses;
  plan.candidates = candidates.count;
  plan.region = region.region;
  plan.hidden = errors.hidden();
  Rng rng(options.seed);
  Exchange exchange(blocks, options.criterion, errors.weights());
  std::vector<int> chosen;
  for (const int count : Ladder(plan.count, candidates.count)) {
    exchange.Choose(count);
    plan.errors.push_back(
        {count, errors.Of(exchange.covariance()), RandomError(informations, errors, count, &rng)});
    if (count == plan.count) chosen = exchange.chosen();
  }
  chosen = InShortWays(candidates, std::move(chosen));
  plan.rows = RowsOfGroups(candidates, chosen);
  for (const int group : chosen) {
    if (edges) plan.edges.push_back(candidates.edges[static_cast<std::size_t>(group)]);
  }
  if (own != nullptr) plan.own = OwnError(spec, *own, *noise, names, errors);
  Conclude(*noise, fit_rms, &plan);
  return plan;
}

}  // namespace dhcal
