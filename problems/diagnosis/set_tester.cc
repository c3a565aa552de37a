#include "problems/diagnosis/set_tester.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <string>

#include <Eigen/Eigenvalues>

#include "core/physics/registry.h"
#include "problems/diagnosis/projection.h"
#include "problems/diagnosis/refine.h"

namespace dhcal {
namespace {

// Signatures are computed at the nominal robot: what is left of a large effect below these shares
// of its size (squared amplitude) is the signature's own error, not another effect.
constexpr double kImmaterial = 0.02 * 0.02;
constexpr double kImmaterialSamePlace = 0.04 * 0.04;
// No maximum of a few hundred normal scores comes near.
constexpr double kHopeless = 7.0;
constexpr double kShareOfScan = 0.2;  // of the false-alarm rate
constexpr std::size_t kMostRefined = 4;
// Lines of one joint's gear that are followed.
constexpr int kMostLines = 8;
// An error curve follows lines below this order (its knots stand closer than half a period).
constexpr double kHighestInCurve = 45;
// Rows that a curve's coefficient must have on average.
constexpr Eigen::Index kRowsPerCoefficient = 15;
// Beside more columns than this, settings found by the scan are not refined any more: each trial
// costs a product with all of them.
constexpr Eigen::Index kManyColumns = 100;

}  // namespace

double Combine(double p_blocks, double p_scan) {
  return std::min({p_blocks / (1 - kShareOfScan), p_scan / kShareOfScan, 1.0});
}

SetTester::SetTester(const SearchOptions& options, HypothesisSpace* space)
    : options_(options), space_(space), scan_width_(ScanWidth(space->context())) {
  Rebuild();
}

void SetTester::Rebuild() {
  tests_ = std::make_unique<BlockTests>(space_->Tests(
      options_.nu, options_.sigma_known, options_.draws, options_.seed, tests_.get()));
  names_.clear();
  for (int k = 0; k < static_cast<int>(space_->all().size()); ++k) {
    const Hypothesis& h = at(k);
    if (!h.named || !h.effect->Describe().may_be_named) continue;
    if (MayBeNamed(h.request.effect)) names_.push_back(k);
  }
  const std::vector<BlockScore> scores = tests_->Scores({});
  order_.resize(scores.size());
  std::iota(order_.begin(), order_.end(), 0);
  std::sort(order_.begin(), order_.end(), [&](int a, int b) {
    return scores[static_cast<std::size_t>(a)].z > scores[static_cast<std::size_t>(b)].z;
  });
}

BlockModel SetTester::Model(const std::vector<int>& members) const {
  BlockModel model;
  for (const int k : members) {
    for (const int column : tests_->Columns(k)) model.columns.push_back(column);
  }
  std::vector<double> sigma;
  const Eigen::VectorXd estimate = members.empty() ? Eigen::VectorXd() : tests_->Estimate(model);
  Eigen::Index first = 0;
  for (const int k : members) {
    const Hypothesis& h = space_->all()[static_cast<std::size_t>(k)];
    if (h.shape_block >= 0 && !shapes_as_stated_) {
      for (const int column : tests_->Columns(h.shape_block)) {
        model.soft.push_back(column);
        sigma.push_back(std::abs(estimate[first]));
      }
    }
    first += h.columns.size;
  }
  model.soft_sigma =
      Eigen::Map<Eigen::VectorXd>(sigma.data(), static_cast<Eigen::Index>(sigma.size()));
  return model;
}

bool SetTester::MayBeNamed(const std::string& effect) const {
  const auto& wanted = options_.effects;
  return wanted.empty() || std::find(wanted.begin(), wanted.end(), effect) != wanted.end();
}

std::vector<SpectralPeak> SetTester::Scan(const std::vector<int>& members) const {
  // What wrong masses leave of an effect is no line either.
  std::vector<int> with_shapes = members;
  for (const int k : members) {
    if (!shapes_as_stated_ && at(k).shape_block >= 0) with_shapes.push_back(at(k).shape_block);
  }
  const Eigen::MatrixXd& extra = Basis(with_shapes);
  Eigen::MatrixXd basis(space_->y().size(), space_->U().cols() + extra.cols());
  basis << space_->U(), extra;
  return ScanOrders(space_->context(),
                    space_->rows(),
                    basis,
                    ProjectOff(extra, space_->y()),
                    options_.nu - static_cast<double>(extra.cols()),
                    options_.sigma_known);
}

double SetTester::LeastScan(const std::vector<SpectralPeak>& peaks) {
  double least = 1;
  for (const SpectralPeak& peak : peaks) least = std::min(least, peak.p_scan);
  return least;
}

const Eigen::MatrixXd& SetTester::Basis(const std::vector<int>& members) const {
  constexpr double kNothingLeft = 1e-4;  // of a column
  const bool grows = basis_members_.size() <= members.size() &&
                     std::equal(basis_members_.begin(), basis_members_.end(), members.begin());
  if (!grows || basis_.rows() == 0) {
    basis_members_.clear();
    basis_.resize(space_->y().size(), 0);
  }
  for (std::size_t i = basis_members_.size(); i < members.size(); ++i) {
    const Eigen::MatrixXd columns = space_->Projected(members[i]);
    const Eigen::MatrixXd beside = ProjectOff(basis_, ProjectOff(basis_, columns));
    std::vector<int> left;
    for (int k = 0; k < static_cast<int>(columns.cols()); ++k) {
      if (beside.col(k).norm() > kNothingLeft * columns.col(k).norm()) left.push_back(k);
    }
    const Eigen::MatrixXd fresh = OrthonormalBasis(beside(Eigen::all, left), 1e-4);
    basis_.conservativeResize(Eigen::NoChange, basis_.cols() + fresh.cols());
    basis_.rightCols(fresh.cols()) = fresh;
    basis_members_.push_back(members[i]);
  }
  return basis_;
}

double SetTester::EvidenceWith(const SpectralPeak& peak, const std::vector<int>& members) const {
  const double left = tests_->gram().rss - tests_->Removed(Model(members));
  return Evidence(members) + Gain(peak.Q, left) - 2 * std::log(options_.nu);
}

double SetTester::Gain(double removed, double rss) const {
  if (options_.sigma_known) return removed;
  return -options_.nu * std::log(std::max(1 - removed / std::max(rss, 1e-300), 1e-12));
}

int SetTester::Known(const EffectRequest& request) {
  for (const int k : names_) {
    if (at(k).request.SameAs(request)) return k;
  }
  const PhysicsContext& context = space_->context();
  if (!MayBeNamed(request.effect) ||
      !FindEffect(request.effect)->NotTestable(context, request).empty()) {
    return -1;
  }
  const int k = space_->AddEffect(request, /*in_maximum=*/false);
  if (IsScannedLine(request)) lines_.push_back(k);
  return k;
}

int SetTester::Curve(int joint) {
  const EffectRequest request = CurveEffect().Request(joint);
  if (!CurveEffect().NotTestable(space_->context(), request).empty()) return -1;
  const auto columns = static_cast<Eigen::Index>(EffectColumns(space_->context(), request).size());
  if (space_->y().size() < kRowsPerCoefficient * columns) return -1;
  const std::size_t before = space_->all().size();
  const int curve = Known(request);
  if (space_->all().size() > before) Rebuild();
  return curve;
}

bool SetTester::InCurve(int hypothesis) const {
  const Hypothesis& h = at(hypothesis);
  return IsOfOwnAngle(h) && h.effect->Order(h.request) < kHighestInCurve;
}

bool SetTester::AddPeaks(const std::vector<SpectralPeak>& peaks, const std::vector<int>& members) {
  const Eigen::MatrixXd& extra = Basis(members);
  const auto is_known = [&](const SpectralPeak& peak) {
    const double resolution = OrderResolution(space_->context(), peak.joint);
    return std::any_of(lines_.begin(), lines_.end(), [&](int line) {
      const EffectRequest& request = at(line).request;
      return request.joint == peak.joint + 1 &&
             std::abs(LineEffect().Order(request) - peak.order) < 0.3 * resolution;
    });
  };
  const auto is_in_curve = [&](const SpectralPeak& peak) {
    return std::any_of(members.begin(), members.end(), [&](int member) {
      return at(member).is_curve() && at(member).request.joint == peak.joint + 1 &&
             peak.order < kHighestInCurve;
    });
  };
  bool any = false;
  for (const SpectralPeak& peak : peaks) {
    if (peak.p_scan > options_.false_alarm || !MayBeNamed(LineEffect().name())) continue;
    if (is_known(peak) || is_in_curve(peak)) continue;
    const EffectRequest line = Line(peak.joint + 1, peak.order);
    const double order =
        extra.cols() > kManyColumns ? peak.order : RefineOrder(*space_, line, peak.order, extra);
    lines_.push_back(space_->AddEffect(Line(peak.joint + 1, order), /*in_maximum=*/false));
    any = true;
  }
  return any;
}

void SetTester::AddRefined(const std::vector<int>& members) {
  const std::vector<BlockScore> scores = tests_->Scores(Model(members));
  const auto score = [&](int k) { return scores[static_cast<std::size_t>(k)].z; };
  std::map<std::string, int> best;  // family -> hypothesis with the highest score
  for (const int k : names_) {
    if (!HasScannedSetting(at(k).request)) continue;
    const auto [entry, is_new] = best.try_emplace(at(k).family, k);
    if (!is_new && score(k) > score(entry->second)) entry->second = k;
  }
  std::vector<int> ranked;
  for (const auto& [family, k] : best) ranked.push_back(k);
  std::sort(ranked.begin(), ranked.end(), [&](int a, int b) { return score(a) > score(b); });
  const Eigen::MatrixXd& extra = Basis(members);
  const std::size_t most = extra.cols() > kManyColumns ? 1 : kMostRefined;
  for (std::size_t k = 0; k < ranked.size() && k < most; ++k) {
    if (score(ranked[k]) < 3) break;
    const EffectRequest refined = RefineSetting(*space_, at(ranked[k]).request, extra);
    const bool known = std::any_of(
        names_.begin(), names_.end(), [&](int other) { return at(other).request.SameAs(refined); });
    if (!known) space_->AddEffect(refined, /*in_maximum=*/false);
  }
}

std::vector<int> SetTester::Polished(std::vector<int> members) {
  constexpr int kRounds = 2;
  constexpr double kMoved = 0.02;  // of a resolution
  if (Model(members).columns.size() > kManyColumns) return members;
  for (int round = 0; round < kRounds; ++round) {
    bool moved = false;
    for (std::size_t i = 0; i < members.size(); ++i) {
      EffectRequest request = at(members[i]).request;
      const bool is_line = IsScannedLine(request);
      if (!is_line && !HasScannedSetting(request)) continue;
      std::vector<int> others = members;
      others.erase(others.begin() + static_cast<long>(i));
      const Eigen::MatrixXd extra = space_->BasisOf(others);
      if (is_line) {
        const double before = LineEffect().Order(request);
        const double order = RefineOrder(*space_, request, before, extra);
        const double resolution = OrderResolution(space_->context(), request.joint - 1);
        if (std::abs(order - before) < kMoved * resolution) continue;
        request = Line(request.joint, order);
      } else {
        const EffectRequest refined = RefineSetting(*space_, request, extra);
        if (refined.SameAs(request)) continue;
        request = refined;
      }
      members[i] = space_->AddEffect(request, /*in_maximum=*/false);
      if (is_line) lines_.push_back(members[i]);
      moved = true;
    }
    if (!moved) break;
    Rebuild();
  }
  return members;
}

Eigen::VectorXd SetTester::Excused(const BlockModel& model, const std::vector<int>& members) const {
  const double removed = tests_->Removed(model);
  std::set<std::string> places;
  std::set<EffectClass> classes;
  std::set<int> joints;
  for (const int k : members) {
    places.insert(at(k).place.location);
    classes.insert(at(k).place.effect_class);
    joints.insert(at(k).request.joint);
  }
  Eigen::VectorXd excused(static_cast<Eigen::Index>(space_->all().size()));
  for (int k = 0; k < static_cast<int>(space_->all().size()); ++k) {
    const Hypothesis& h = at(k);
    const bool same =
        h.named ? places.count(h.place.location) > 0 || classes.count(h.place.effect_class) > 0
                : places.count(h.slot) > 0 || (h.slot_joint > 0 && joints.count(h.slot_joint) > 0);
    excused[k] = removed * (same ? kImmaterialSamePlace : kImmaterial);
  }
  return excused;
}

double SetTester::LinesLeft(const BlockModel& model) const {
  double least = 1;
  if (lines_.empty()) return least;
  for (const BlockScore& score : tests_->Scores(model, lines_)) {
    if (score.k > 0) least = std::min(least, ScanChance(score.p));
  }
  return least;
}

TestedSet SetTester::Try(const std::vector<int>& members, bool rescan) const {
  const BlockModel model = Model(members);
  const Eigen::VectorXd excused = Excused(model, members);
  TestedSet set;
  set.members = members;
  if (!tests_->MayFit(model, order_, kHopeless, excused)) return set;
  const double p_lines = LinesLeft(model);
  if (p_lines <= options_.false_alarm * kShareOfScan) return set;
  set.p = Combine(tests_->Test(model, options_.false_alarm, excused).p, p_lines);
  // A new scan costs much; a model that leaves no known line hardly leaves another.
  if (rescan && set.p > options_.false_alarm) {
    set.p = std::min(set.p, Combine(1, LeastScan(Scan(members))));
  }
  set.kept = set.p > options_.false_alarm;
  return set;
}

double SetTester::Evidence(const std::vector<int>& members) const {
  const BlockModel model = Model(members);
  const double removed = tests_->Removed(model);
  const double gain = Gain(removed, tests_->gram().rss);
  const double noise = options_.sigma_known ? 1 : (tests_->gram().rss - removed) / options_.nu;
  double price = 0;
  for (const int k : members) price += Price(k, noise);
  return gain - price;
}

double SetTester::Price(int k, double noise) const {
  const ColumnRange& range = at(k).columns;
  const double by_count = range.size * std::log(options_.nu);
  if (!at(k).is_curve()) return by_count;
  // Coefficients with a prior: only those that the rows determine cost anything (the determinant of
  // the Laplace approximation, physics.md B.2).
  auto& squares = curve_squares_[k];
  if (squares.size() == 0) {
    squares = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(
                  tests_->gram().S.block(range.first, range.first, range.size, range.size),
                  Eigen::EigenvaluesOnly)
                  .eigenvalues()
                  .cwiseMax(0.0);
  }
  return (squares.array() * (at(k).prior_variance / noise)).log1p().sum();
}

bool SetTester::Conflicts(int k, const std::vector<int>& members) const {
  const EffectRequest& mine = at(k).request;
  int lines = 0;
  for (const int m : members) {
    if (m == k) return true;
    const EffectRequest& other = at(m).request;
    const bool a_curve = at(k).is_curve() || at(m).is_curve();
    if (a_curve && mine.joint == other.joint && InCurve(k) && InCurve(m)) return true;
    if (other.effect != mine.effect || other.joint != mine.joint) continue;
    const PerJoint per_joint = at(k).effect->Describe().per_joint;
    if (per_joint == PerJoint::kOne || other.SameAs(mine)) return true;
    if (per_joint == PerJoint::kOfEachKind) continue;
    ++lines;
    const double apart = std::abs(LineEffect().Order(other) - LineEffect().Order(mine));
    const double resolution = OrderResolution(space_->context(), mine.joint - 1);
    if (apart < 0.8 * std::min(resolution, 1.0) || lines >= kMostLines) return true;
  }
  return false;
}

}  // namespace dhcal
