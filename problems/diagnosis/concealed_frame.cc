#include "problems/diagnosis/concealed_frame.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/units.h"
#include "core/math/statistics.h"
#include "problems/diagnosis/design_rows.h"
#include "problems/prediction.h"

namespace dhcal {
namespace {

constexpr double kSameDirection = 0.999;  // cosine of two columns
constexpr std::size_t kMostNamed = 3;

std::string Amount(const RowCorrection& correction) {
  const std::string unit = correction.parameter.unit == Unit::kRadian ? "mrad" : "mm";
  return fmt::format("{} by {:+.1f} {} ({:.0f} times its tolerance of {:g} {})",
                     correction.parameter.name,
                     correction.value / 1e-3,
                     unit,
                     correction.tolerances(),
                     correction.tolerance() / 1e-3,
                     unit);
}

std::string Amounts(const std::vector<RowCorrection>& corrections) {
  std::vector<std::string> named;
  for (std::size_t k = 0; k < corrections.size() && k < kMostNamed; ++k) {
    named.push_back(Amount(corrections[k]));
  }
  return fmt::format("{}", fmt::join(named, " and "));
}

/// Pairs (the file's parameter, the completion's) that move all readings alike.
std::vector<std::string> SameDirections(const HeldFit& fit,
                                        const std::vector<RowCorrection>& own,
                                        const Completion& completion) {
  const Calibration& c = fit.calibration;
  const DesignRows rows(c, fit.state(), fit.fit.noise_seen, c.readings.fitted);
  std::vector<std::string> pairs;
  for (const RowCorrection& correction : own) {
    const Eigen::MatrixXd a = rows.Geometry({correction.parameter});
    for (const Parameter& p : completion.parameters) {
      const Eigen::MatrixXd b = rows.Geometry({p});
      const double lengths = a.norm() * b.norm();
      if (!(lengths > 0) || std::abs(a.col(0).dot(b.col(0))) < kSameDirection * lengths) continue;
      pairs.push_back(fmt::format("{} from {}", correction.parameter.name, p.name));
    }
  }
  return pairs;
}

/// The implausible corrections of a held fit, as large as the file's own fit makes them where it
/// has an answer: the tolerances of the held one pull them back a little.
std::vector<RowCorrection> Implausible(const HeldFit& held, const Result& identified) {
  std::vector<RowCorrection> corrections = ImplausibleCorrections(held);
  if (identified.best() == nullptr) return corrections;
  for (RowCorrection& correction : corrections) {
    for (const ParameterResult& own : identified.best()->parameters) {
      if (own.name != correction.parameter.name) continue;
      if (std::abs(own.correction) > std::abs(correction.value)) correction.value = own.correction;
    }
  }
  return corrections;
}

/// Why this is said although the file's own parameters fit the readings too.
std::vector<std::string> Cautions(const std::vector<RowCorrection>& own,
                                  const HeldFit& with,
                                  const Completion& completion) {
  if (own.empty()) {
    return {"the file's own parameters, held by their tolerances, could not be fitted at all"};
  }
  std::vector<std::string> cautions;
  cautions.push_back(fmt::format(
      "the file's own parameters can imitate it, so that the residuals show little of "
      "it, but only by changing {}; manufacture and mastering do not err so far, a "
      "file that leaves something out does. The RMS before is that of the file's values "
      "as they stand",
      Amounts(own)));
  const std::vector<std::string> pairs = SameDirections(with, own, completion);
  if (!pairs.empty()) {
    cautions.push_back(
        fmt::format("the readings cannot tell {}: they move the measured point alike. If the robot "
                    "has nothing of the kind, that value of the file is wrong instead; look at the "
                    "robot",
                    fmt::join(pairs, ", ")));
  }
  return cautions;
}

void AddMoved(const std::vector<RowCorrection>& own, const HeldFit& with, DiagnosisResult* d) {
  for (const RowCorrection& correction : own) {
    for (std::size_t k = 0; k < with.calibration.parameters.size(); ++k) {
      const Parameter& p = with.calibration.parameters[k];
      if (p.name != correction.parameter.name) continue;
      MovedParameter moved;
      moved.name = p.name;
      moved.unit = p.unit;
      moved.before = correction.value;
      moved.after = with.state()[static_cast<Eigen::Index>(k)];
      moved.sigma = correction.tolerance();
      d->moved.push_back(moved);
    }
  }
}

bool Plausible(const HeldFit& fit) { return fit.usable() && ImplausibleCorrections(fit).empty(); }

/// The completion that frees the file's parameters most of what the drawing has against them; none
/// if it is no more than chance and usual errors can do.
std::pair<std::size_t, std::unique_ptr<HeldFit>> Best(const ProblemSpec& spec,
                                                      const Recording& recording,
                                                      const Noise& noise,
                                                      const HeldFit& without,
                                                      const std::vector<Completion>& left) {
  constexpr double kRelief = kPlausibleTolerances * kPlausibleTolerances;
  std::pair<std::size_t, std::unique_ptr<HeldFit>> best{left.size(), nullptr};
  for (std::size_t k = 0; k < left.size(); ++k) {
    auto with = FitHeld(WithCompletion(spec, left[k]), recording, noise);
    if (!with->usable()) continue;
    const bool relieves = without.usable() ? Penalty(without) - Penalty(*with) > kRelief &&
                                                 without.total() - with->total() > kRelief
                                           : Plausible(*with);
    if (!relieves || (best.second && best.second->total() <= with->total())) continue;
    best = {k, std::move(with)};
  }
  return best;
}

Finding DescribeConcealed(const HeldFit& without,
                          const HeldFit& with,
                          const Completion& completion,
                          const std::vector<RowCorrection>& own) {
  const auto freedoms = static_cast<double>(completion.parameters.size());
  const double p =
      without.usable() ? ChiSquareTail(without.total() - with.total(), freedoms) : kUnknown;
  Finding finding = DescribeCompletion(completion, with.calibration, with.fit, p);
  finding.cautions = Cautions(own, with, completion);
  // Held to the drawing the file predicts this; a fit of its parameters is no measure, it hides it.
  const Eigen::VectorXd drawing =
      Eigen::VectorXd::Zero(static_cast<Eigen::Index>(without.calibration.parameters.size()));
  finding.rms_train_before =
      Statistics(without.calibration, drawing, without.calibration.readings.fitted).rms;
  finding.rms_train_after =
      Statistics(with.calibration, with.state(), with.calibration.readings.fitted).rms;
  return finding;
}

}  // namespace

DiagnosisResult ConcealedFrames(const ProblemSpec& spec,
                                const Recording& recording,
                                const Result& identified,
                                const CompleteFit& complete,
                                const std::vector<Completion>& completions) {
  DiagnosisResult d;
  const Noise& noise = complete.fit.noise_seen;
  ProblemSpec freed = spec;
  auto fit = FitHeld(freed, recording, noise);
  std::vector<Completion> left = completions;
  while (!left.empty() && !Plausible(*fit)) {
    auto [k, with] = Best(freed, recording, noise, *fit, left);
    if (!with) break;
    const std::vector<RowCorrection> own =
        fit->usable() ? Implausible(*fit, identified) : std::vector<RowCorrection>();
    d.findings.push_back(DescribeConcealed(*fit, *with, left[k], own));
    AddMoved(own, *with, &d);
    freed = WithCompletion(freed, left[k]);
    left.erase(left.begin() + static_cast<long>(k));
    fit = std::move(with);
  }
  if (fit->usable() && !Plausible(*fit)) {
    d.notes.push_back(fmt::format(
        "The fit changes {}. Manufacture and mastering do not err so far, and no frame explains "
        "it: check these values of the file, and the joints' zeros and signs.",
        Amounts(ImplausibleCorrections(*fit))));
  }
  return d;
}

}  // namespace dhcal
