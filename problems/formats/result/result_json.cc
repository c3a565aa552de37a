// result.json (FORMATS.md, section 3).
#include <string>
#include <utility>
#include <vector>

#include "core/io/json_values.h"
#include "problems/formats/result/diagnosis_json.h"
#include "problems/formats/result/result_writer.h"

namespace dhcal {
namespace {

constexpr int kResultSchema = 1;

Json TraceToJson(const std::vector<IterationRecord>& trace) {
  Json array = Json::array();
  for (const IterationRecord& record : trace) {
    Json entry = Json::object();
    SetCount("iteration", record.iteration, &entry);
    Set("cost", record.cost, &entry);
    Set("kappa_norm", record.kappa_norm, &entry);
    SetCount("rank", record.rank, &entry);
    Set("step_norm", record.step_norm, &entry);
    array.push_back(std::move(entry));
  }
  return array;
}

std::string UnitName(const ParameterResult& parameter) {
  return parameter.unit == Unit::kOther ? parameter.unit_text : ToString(parameter.unit);
}

Json ParametersToJson(const std::vector<ParameterResult>& parameters) {
  Json array = Json::array();
  for (const ParameterResult& parameter : parameters) {
    Json entry = {{"name", parameter.name}, {"unit", UnitName(parameter)}};
    Set("nominal", parameter.nominal, &entry);
    Set("correction", parameter.correction, &entry);
    Set("value", parameter.value, &entry);
    Set("sigma", parameter.sigma, &entry);
    SetArray("ci95", {parameter.ci95_low, parameter.ci95_high}, &entry);
    entry["verdict"] = ToString(parameter.verdict);
    entry["confounded_with"] = parameter.confounded_with;
    entry["explanation"] = parameter.explanation;
    array.push_back(std::move(entry));
  }
  return array;
}

Json NullSpaceToJson(const std::vector<NullDirection>& null_space) {
  Json array = Json::array();
  for (const NullDirection& null_direction : null_space) {
    Json direction = Json::array();
    for (const NullDirection::Entry& entry : null_direction.direction) {
      Json named = {{"name", entry.name}};
      Set("weight", entry.weight, &named);
      direction.push_back(std::move(named));
    }
    array.push_back(
        {{"direction", std::move(direction)}, {"explanation", null_direction.explanation}});
  }
  return array;
}

Json ObservabilityToJson(const ObservabilityIndices& indices) {
  Json object = Json::object();
  Set("O1", indices.o1, &object);
  Set("O2", indices.o2, &object);
  Set("O3", indices.o3, &object);
  Set("O4", indices.o4, &object);
  Set("O5", indices.o5, &object);
  return object;
}

void SetSpectrum(const FitResult& fit, Json* entry) {
  SetArray("singular_values", fit.singular_values, entry);
  SetText("singular_values_of", fit.singular_values_of, entry);
  Set("truncation_cut", fit.truncation_cut, entry);
  Set("condition_number", fit.condition_number, entry);
  Json observability = ObservabilityToJson(fit.observability);
  if (!observability.empty()) (*entry)["observability"] = std::move(observability);
}

/// The lower triangle, row by row; nothing where it was not computed.
void SetCovariance(const Eigen::MatrixXd& covariance, Json* entry) {
  if (covariance.size() == 0 || !covariance.allFinite()) return;
  Json& rows = (*entry)["covariance"] = Json::array();
  for (Eigen::Index i = 0; i < covariance.rows(); ++i) {
    std::vector<double> row;
    for (Eigen::Index j = 0; j <= i; ++j) row.push_back(covariance(i, j));
    rows.push_back(std::move(row));
  }
}

Json FitToJson(const FitResult& fit) {
  Json entry = {{"solver", ToString(fit.solver)},
                {"converged", fit.converged},
                {"usable", fit.usable},
                {"termination", ToString(fit.termination)},
                {"message", fit.message}};
  SetCount("iterations", fit.iterations, &entry);
  SetCount("rank", fit.rank, &entry);
  SetCount("rank_numerical", fit.rank_numerical, &entry);
  SetCount("columns", fit.columns, &entry);
  Set("kappa_norm", fit.kappa_norm, &entry);
  Set("cost", fit.cost, &entry);
  Set("chi2_reduced", fit.chi2_reduced, &entry);
  Set("chi2_p", fit.chi2_p, &entry);
  Set("seconds", fit.seconds, &entry);
  Set("rms_m", fit.rms, &entry);
  Set("rms_point_m", fit.rms_point, &entry);
  Set("max_point_m", fit.max_point, &entry);
  Set("rms_rotation_rad", fit.rms_rotation, &entry);
  SetSpectrum(fit, &entry);
  entry["trace"] = TraceToJson(fit.trace);
  if (fit.usable) {
    entry["parameters"] = ParametersToJson(fit.parameters);
    entry["null_space"] = NullSpaceToJson(fit.null_space);
  }
  if (fit.usable) SetCovariance(fit.covariance, &entry);
  SetText("covariance_check", fit.covariance_check, &entry);
  Set("covariance_difference", fit.covariance_difference, &entry);
  return entry;
}

Json ComparisonToJson(const std::vector<ComparedParameter>& comparison) {
  Json parameters = Json::array();
  for (const ComparedParameter& parameter : comparison) {
    Json entry = {{"name", parameter.name}, {"unit", ToString(parameter.unit)}};
    Set("svd_gauss_newton", parameter.svd_gauss_newton, &entry);
    Set("levenberg_marquardt", parameter.levenberg_marquardt, &entry);
    Set("difference", parameter.difference, &entry);
    Set("in_null_space", parameter.in_null_space, &entry);
    parameters.push_back(std::move(entry));
  }
  return {{"parameters", std::move(parameters)}};
}

Json BaselineToJson(const Baseline& baseline) {
  Json object = Json::object();
  Set("rms_m", baseline.rms, &object);
  Set("rms_point_m", baseline.rms_point, &object);
  Set("max_point_m", baseline.max_point, &object);
  return object;
}

Json ValidationToJson(const ValidationResult& validation) {
  Json object = {{"method", validation.method}};
  SetCount("rows", validation.rows, &object);
  Set("rms_train_m", validation.rms_train, &object);
  Set("rms_test_m", validation.rms_test, &object);
  Set("rms_point_test_m", validation.rms_point_test, &object);
  Set("max_point_test_m", validation.max_point_test, &object);
  Set("noise_sigma_m", validation.noise_sigma, &object);
  return object;
}

/// What was read and what the statistics stand on.
Json HeadToJson(const Result& result) {
  Json head = {{"schema", kResultSchema},
               {"problem", result.problem},
               {"program_version", result.program_version},
               {"kind", result.kind.name},
               {"simulated", result.simulated}};
  SetCount("rows", result.rows, &head);
  SetCount("rows_test", result.rows_test, &head);
  SetCount("num_poses", result.num_poses, &head);
  Set("noise_sigma_m", result.noise_sigma, &head);
  Set("noise_sigma_rotation_rad", result.noise_sigma_rotation, &head);
  SetText("noise_source", result.noise_source, &head);
  SetCount("best_fit", result.best_fit, &head);
  if (result.best() != nullptr) head["intervals"] = ToString(result.intervals);
  return head;
}

Json EffectsToJson(const std::vector<EffectRequest>& effects) {
  Json array = Json::array();
  for (const EffectRequest& effect : effects) {
    Json entry = {{"effect", effect.effect}};
    if (effect.joint > 0) entry["joint"] = effect.joint;
    Json settings = effect.settings;
    for (const auto& [key, word] : effect.words) settings[key] = word;
    if (!settings.empty()) entry["settings"] = settings;
    entry["values"] = effect.values;
    array.push_back(std::move(entry));
  }
  return array;
}

Json DeliveredToJson(const DeliveredModel& model) {
  Json object = Json::object();
  Set("rms_m", model.fit.rms, &object);
  Set("rms_point_m", model.fit.rms_point, &object);
  Set("max_point_m", model.fit.max_point, &object);
  Set("rms_test_m", model.validation.rms_test, &object);
  Set("rms_point_test_m", model.validation.rms_point_test, &object);
  object["intervals"] = ToString(model.intervals);
  object["effects"] = EffectsToJson(model.effects);
  object["parameters"] = ParametersToJson(model.fit.parameters);
  object["null_space"] = NullSpaceToJson(model.fit.null_space);
  SetCovariance(model.fit.covariance, &object);
  return object;
}

Json TaskToJson(const TaskError& task) {
  Json object = {{"region", task.region}, {"aligned", task.aligned}};
  SetCount("poses", task.poses, &object);
  SetText("unknown", task.unknown, &object);
  if (!task.unknown.empty()) return object;
  Set("before_rms_m", task.before.rms, &object);
  SetArray("before_ci95_m", {task.before.low, task.before.high}, &object);
  Set("after_rms_m", task.after.rms, &object);
  SetArray("after_ci95_m", {task.after.low, task.after.high}, &object);
  Set("after_largest_m", task.after_largest, &object);
  Set("hidden_rms_m", task.hidden, &object);
  object["effects_left_out"] = task.left_out;
  return object;
}

Json SetAsideToJson(const std::vector<RowSetAside>& rows) {
  Json array = Json::array();
  for (const RowSetAside& row : rows) {
    Json entry = {
        {"row", row.row_idx + 1}, {"set", row.test ? "test" : "train"}, {"reason", row.reason}};
    Set("size_m", row.size, &entry);
    array.push_back(std::move(entry));
  }
  return array;
}

Json CausesToJson(const std::vector<SetupCause>& causes) {
  Json array = Json::array();
  for (const SetupCause& cause : causes) {
    Json entry = {{"kind", cause.kind},
                  {"joints", cause.joints},
                  {"alternative", cause.alternative},
                  {"sentence", cause.sentence},
                  {"fix", {{"file", cause.where.file}, {"text", cause.text}}}};
    if (cause.where.line > 0) entry["fix"]["line"] = cause.where.line;
    Set("rms_before_m", cause.rms_before, &entry);
    Set("rms_after_m", cause.rms_after, &entry);
    array.push_back(std::move(entry));
  }
  return array;
}

Json SetupToJson(const SetupResult& setup) {
  return {{"plausible", setup.plausible},
          {"reasons", setup.reasons},
          {"causes", CausesToJson(setup.causes)},
          {"cured", setup.cured},
          {"remarks", setup.remarks}};
}

}  // namespace

std::string ResultToJson(const Result& result) {
  Json root = HeadToJson(result);
  root["setup"] = SetupToJson(result.setup);
  root["fits"] = Json::array();
  for (const FitResult& fit : result.fits) root["fits"].push_back(FitToJson(fit));
  if (!result.comparison.empty()) root["comparison"] = ComparisonToJson(result.comparison);
  root["baseline"] = {{"nominal", BaselineToJson(result.nominal)}};
  if (result.base_and_tool_only) {
    root["baseline"]["base_and_tool_only"] = BaselineToJson(*result.base_and_tool_only);
  }
  if (!result.validation.method.empty()) root["validation"] = ValidationToJson(result.validation);
  if (result.delivered) root["delivered"] = DeliveredToJson(*result.delivered);
  if (result.task) root["task"] = TaskToJson(*result.task);
  if (result.diagnosis) root["rows_set_aside"] = SetAsideToJson(result.rows_set_aside);
  if (result.diagnosis) root["diagnosis"] = DiagnosisToJson(*result.diagnosis);
  root["notes"] = result.notes;
  // A file name need not be UTF-8; a replaced character is better than no result.
  return root.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace dhcal
