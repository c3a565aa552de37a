#include "problems/formats/result/diagnosis_json.h"

#include <string>
#include <utility>
#include <vector>

namespace dhcal {
namespace {

/// {"effect": ..., "joint": ..., settings...}
Json EffectToJson(const EffectRequest& request) {
  Json object = {{"effect", request.effect}};
  object["joint"] = request.joint > 0 ? Json(request.joint) : Json(nullptr);
  for (const auto& [key, word] : request.words) object[key] = word;
  for (const auto& [key, value] : request.settings) object[key] = value;
  return object;
}

Json MisfitToJson(const Misfit& misfit) {
  Json object = Json::object();
  Set("statistic", misfit.statistic, &object);
  Set("dof", misfit.dof, &object);
  Set("p_value", misfit.p_value, &object);
  Set("p_floor", misfit.p_floor, &object);
  Set("noise_sigma_m", misfit.noise_sigma, &object);
  object["noise_known"] = misfit.noise_known;
  Set("rms_m", misfit.rms, &object);
  SetCount("rows", misfit.rows, &object);
  SetCount("outliers", misfit.outliers, &object);
  Json rows = Json::array();
  for (const int row : misfit.outlier_rows) rows.push_back(row + 1);
  object["outlier_rows"] = std::move(rows);
  return object;
}

Json MapToJson(const std::vector<MapEntry>& map) {
  Json array = Json::array();
  for (const MapEntry& entry : map) {
    Json object = {{"slot", entry.slot}, {"driver", entry.driver}};
    Set("statistic", entry.statistic, &object);
    Set("dof", entry.dof, &object);
    Set("p_value", entry.p_value, &object);
    Set("rms_m", entry.rms, &object);
    array.push_back(std::move(object));
  }
  return array;
}

Json HypothesesToJson(const std::vector<HypothesisResult>& hypotheses) {
  Json array = Json::array();
  for (const HypothesisResult& hypothesis : hypotheses) {
    Json effects = Json::array();
    for (const EffectRequest& request : hypothesis.effects) {
      effects.push_back(EffectToJson(request));
    }
    Json object = {{"effects", std::move(effects)}};
    Set("p_value", hypothesis.p_value, &object);
    object["kept"] = hypothesis.kept;
    array.push_back(std::move(object));
  }
  return array;
}

Json FoundParametersToJson(const std::vector<FoundParameter>& parameters) {
  Json array = Json::array();
  for (const FoundParameter& parameter : parameters) {
    Json object = {{"name", parameter.name}};
    Set("value", parameter.value, &object);
    Set("sigma", parameter.sigma, &object);
    SetArray("ci95", {parameter.ci95_low, parameter.ci95_high}, &object);
    object["unit"] = parameter.unit;
    array.push_back(std::move(object));
  }
  return array;
}

Json PosesToJson(const std::vector<SeparatingPose>& poses) {
  Json array = Json::array();
  for (const SeparatingPose& pose : poses) {
    Json object = {{"q", std::vector<double>(pose.q.begin(), pose.q.end())}};
    Set("payload_kg", pose.payload, &object);
    array.push_back(std::move(object));
  }
  return array;
}

Json FindingToJson(const Finding& finding) {
  Json object = EffectToJson(finding.effect);
  object["class"] = finding.effect_class;
  object["location"] = finding.location;
  object["driver"] = finding.driver;
  object["parameters"] = FoundParametersToJson(finding.parameters);
  object["sentence"] = finding.sentence;
  object["cautions"] = finding.cautions;
  Set("p_value", finding.p_value, &object);
  Set("rms_train_before_m", finding.rms_train_before, &object);
  Set("rms_train_after_m", finding.rms_train_after, &object);
  Set("rms_test_before_m", finding.rms_test_before, &object);
  Set("rms_test_after_m", finding.rms_test_after, &object);
  Json evidence = Json::object();
  Set("delta_bic", finding.delta_bic, &evidence);
  Set("delta_log_predictive", finding.delta_log_predictive, &evidence);
  Set("log_predictive_standard_error", finding.log_predictive_standard_error, &evidence);
  object["evidence"] = std::move(evidence);
  Json confusable = Json::array();
  for (const Confusable& other : finding.confusable_with) {
    Json entry = EffectToJson(other.effect);
    entry["location"] = other.location;
    Set("overlap", other.overlap, &entry);
    confusable.push_back(std::move(entry));
  }
  object["confusable_with"] = std::move(confusable);
  SetText("separating_advice", finding.separating_advice, &object);
  object["separating_poses"] = PosesToJson(finding.separating_poses);
  return object;
}

Json UnexplainedToJson(const Unexplained& rest) {
  Json object = Json::object();
  Set("fraction", rest.fraction, &object);
  object["slot"] = rest.slot;
  object["driver"] = rest.driver;
  SetText("driver_unit", rest.driver_unit, &object);
  object["unit"] = ToString(rest.unit);
  Set("rms_m", rest.rms, &object);
  Json curve = Json::array();
  for (const CurvePoint& point : rest.curve) {
    Json entry = Json::object();
    Set("driver_value", point.driver_value, &entry);
    Set("amount", point.amount, &entry);
    Set("sigma", point.sigma, &entry);
    curve.push_back(std::move(entry));
  }
  object["curve"] = std::move(curve);
  return object;
}

Json HiddenToJson(const std::vector<HiddenRisk>& hidden) {
  Json array = Json::array();
  for (const HiddenRisk& risk : hidden) {
    Json object = EffectToJson(risk.effect);
    Set("visibility", risk.visibility, &object);
    Set("detection_limit", risk.limit, &object);
    SetText("unit", risk.unit, &object);
    Set("risk_elsewhere_m", risk.risk, &object);
    array.push_back(std::move(object));
  }
  return array;
}

Json MovedToJson(const std::vector<MovedParameter>& moved) {
  Json array = Json::array();
  for (const MovedParameter& parameter : moved) {
    Json object = {{"name", parameter.name}, {"unit", ToString(parameter.unit)}};
    Set("correction_before", parameter.before, &object);
    Set("correction_after", parameter.after, &object);
    Set("sigma", parameter.sigma, &object);
    array.push_back(std::move(object));
  }
  return array;
}

}  // namespace

Json DiagnosisToJson(const DiagnosisResult& d) {
  Json object = {{"verdict", ToString(d.verdict)}, {"summary", d.summary}};
  Set("false_alarm", d.false_alarm, &object);
  object["misfit"] = MisfitToJson(d.misfit);
  object["map"] = MapToJson(d.map);
  object["hypotheses"] = HypothesesToJson(d.hypotheses);
  object["findings"] = Json::array();
  for (const Finding& finding : d.findings) object["findings"].push_back(FindingToJson(finding));
  if (d.unexplained) object["unexplained"] = UnexplainedToJson(*d.unexplained);
  SetText("validation_method", d.validation_method, &object);
  Set("rms_train_before_m", d.rms_train_before, &object);
  Set("rms_train_after_m", d.rms_train_after, &object);
  Set("rms_test_before_m", d.rms_test_before, &object);
  Set("rms_test_after_m", d.rms_test_after, &object);
  object["moved_parameters"] = MovedToJson(d.moved);
  object["hidden"] = HiddenToJson(d.hidden);
  Json not_testable = Json::array();
  for (const NotTestable& entry : d.not_testable) {
    not_testable.push_back({{"effect", entry.effect}, {"reason", entry.reason}});
  }
  object["not_testable"] = std::move(not_testable);
  object["notes"] = d.notes;
  Set("seconds", d.seconds, &object);
  return object;
}

}  // namespace dhcal
