// What was read and asked.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include <fmt/format.h>

#include "core/base/units.h"
#include "core/report/format.h"
#include "core/report/sections.h"

namespace dhcal {
namespace {

std::string FileName(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

std::string RobotText(const RobotModel& robot) {
  return fmt::format("{}{}, {} Denavit-Hartenberg convention",
                     robot.name.empty() ? "" : robot.name + ", ",
                     Counted(robot.num_joints(), "joint"),
                     robot.convention == DhConvention::kStandard ? "standard" : "modified");
}

std::string RecordingText(const ProblemSpec& spec, const Result& result) {
  if (!result.simulated) return FileName(spec.recording);
  if (!spec.simulate) return "simulated";
  return fmt::format("simulated with known errors, noise {} mm, seed {}",
                     spec.simulate->noise / kMillimetre,
                     spec.simulate->seed);
}

std::string RowsText(const Result& result) {
  std::string text = fmt::format("{} fitted", std::max(result.rows, 0));
  if (result.rows_test > 0) text += fmt::format(", {} kept unseen", result.rows_test);
  if (!result.rows_set_aside.empty()) {
    text += fmt::format(", {} excluded (see below)", result.rows_set_aside.size());
  }
  if (result.num_poses >= 0) text += fmt::format(", from {}", Counted(result.num_poses, "pose"));
  return text;
}

std::string NoiseText(const Result& result) {
  if (std::isnan(result.noise_sigma)) return "not known";
  std::string text = Millimetres(result.noise_sigma) + " mm per measured coordinate";
  if (!std::isnan(result.noise_sigma_rotation)) {
    text += fmt::format(", {:.4g} mrad per rotation", result.noise_sigma_rotation / kMilliradian);
  }
  if (!result.noise_source.empty()) text += ", " + result.noise_source;
  return text;
}

std::string TruncationText(const SolverSpec& solver) {
  switch (solver.rule) {
    case TruncationRule::kNoise:
      return "noise";
    case TruncationRule::kPaper:
      return "paper (columns * machine epsilon)";
    case TruncationRule::kRelative:
      return fmt::format("{:g} of the largest", solver.relative_tolerance);
  }
  return "?";
}

std::string LossText(const SolverSpec& solver) {
  const std::string scale = fmt::format(" at {:g} sigma", solver.loss_scale);
  switch (solver.loss) {
    case LossKind::kNone:
      return "";
    case LossKind::kHuber:
      return ", Huber loss" + scale;
    case LossKind::kCauchy:
      return ", Cauchy loss" + scale;
    case LossKind::kTukey:
      return ", Tukey loss" + scale;
  }
  return "";
}

std::string SolverText(const SolverSpec& solver) {
  const std::string method = solver.method == SolverMethod::kBoth
                                 ? SolverName(SolverMethod::kSvdGaussNewton) + " and " +
                                       SolverName(SolverMethod::kLevenbergMarquardt)
                                 : SolverName(solver.method);
  return fmt::format("{}, truncation rule {}, kappa {:g} m, at most {}{}",
                     method,
                     TruncationText(solver),
                     solver.kappa,
                     Counted(solver.max_iterations, "iteration"),
                     LossText(solver));
}

}  // namespace

std::string SolverName(SolverMethod method) {
  return method == SolverMethod::kLevenbergMarquardt ? "Levenberg-Marquardt" : "SVD Gauss-Newton";
}

Section InputSection(const ProblemSpec& spec, const Result& result) {
  List facts;
  facts.kind = List::Kind::kTerms;
  facts.items = {
      {FileName(spec.file), "Problem file", {}},
      {RobotText(spec.robot), "Robot", {}},
      {RecordingText(spec, result), "Recording", {}},
      {RowsText(result), "Rows", {}},
      {fmt::format("{} ({})", result.kind.sentence, result.kind.name), "Measurement", {}},
      {NoiseText(result), "Noise", {}},
      {SolverText(spec.solver), "Solver", {}}};
  return {"", {facts}};
}

}  // namespace dhcal
