#include "problems/diagnosis/hypotheses/library.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "core/base/text.h"
#include "core/base/units.h"
#include "core/physics/gravity.h"
#include "core/physics/registry.h"
#include "core/physics/step.h"
#include "problems/diagnosis/hypotheses/loads.h"

namespace dhcal {
namespace {

constexpr int kInstantsTried = 47;
constexpr int kInstantsAtFirst = 12;
constexpr int kInstantsOfAClockedPlace = 400;
// Time constants in parts of the longest run; 0 = steadily.
constexpr double kTimeConstantsTried[] = {0.05, 0.08, 0.12, 0.19, 0.3, 0.5, 0.8, 0.0};
constexpr int kCurveKnotsTried[] = {8, 14, 28, 120};
constexpr int kPosesPerKnot = 20;
constexpr int kFewestKnots = 4;
constexpr int kOrdersOfAScan = 150;
constexpr char kColumn[] = "column";  // setting
// The names that search this scan: a line of free order is chosen from all of them.
constexpr double kHighestWholeOrder = 7;

/// Settings that are found by scanning and do not make another finding.
bool IsScannedSetting(const std::string& name) {
  return name == "at_s" || name == "at_row" || name == "time_constant_s" ||
         name == "soft_torque_Nm" || name == "knot_deg" || name == "measured_torque" ||
         name == "flank" || name == "jumps" || name == "friction_Nm" || name == "free_masses" ||
         name == kMomentLink || name == kMomentDegrees;
}

std::string IdOf(const EffectRequest& request) {
  std::string id = request.effect;
  if (request.joint > 0) id += fmt::format(".{}", request.joint);
  for (const auto& [name, word] : request.words) id += fmt::format(".{}={}", name, word);
  for (const auto& [name, value] : request.settings) {
    if (!IsScannedSetting(name)) id += fmt::format(".{}={:.6g}", name, value);
  }
  return id;
}

/// Whatever column a slot follows is one name, and the choice of the column one of form: many
/// columns that nobody knows must not make all other names dear.
std::string CountedAs(EffectRequest request) {
  request.words.erase(kColumn);
  return IdOf(request);
}

bool TakesSetting(const Effect& effect, const std::string& name) {
  const auto settings = effect.Describe().settings;
  return std::any_of(
      settings.begin(), settings.end(), [&](const auto& s) { return s.first == name; });
}

/// The same place without its scanned setting, each once.
std::vector<EffectRequest> Places(const std::vector<EffectRequest>& requests,
                                  const std::string& setting) {
  std::vector<EffectRequest> places;
  for (EffectRequest request : requests) {
    request.settings.erase(setting);
    const bool known = std::any_of(
        places.begin(), places.end(), [&](const EffectRequest& p) { return p.SameAs(request); });
    if (!known) places.push_back(request);
  }
  return places;
}

bool UsableTorque(const PhysicsContext& c, const Effect& effect, EffectRequest request) {
  request.settings["measured_torque"] = 1;
  return effect.NotTestable(c, request).empty();
}

std::vector<EffectRequest> AllPairs(const PhysicsContext& c, const std::string& effect) {
  std::vector<EffectRequest> pairs;
  for (int joint = 1; joint <= c.num_joints(); ++joint) {
    for (int driver = 1; driver <= c.num_joints(); ++driver) {
      if (driver == joint) continue;
      EffectRequest request;
      request.effect = effect;
      request.joint = joint;
      request.settings["driver_joint"] = driver;
      pairs.push_back(request);
    }
  }
  return pairs;
}

/// Instants between rows, evenly, and every one around those of `near`.
std::vector<double> InstantsTried(const PhysicsContext& c,
                                  int count,
                                  const std::vector<double>& near) {
  const std::vector<double> times = Instants(c);
  const auto num = static_cast<int>(times.size());
  std::set<int> at;
  for (int k = 1; k <= count; ++k) at.insert(k * num / (count + 1));
  const int step = num / (count + 1) + 1;
  for (const double instant : near) {
    const auto middle = static_cast<int>(
        std::lower_bound(times.begin(), times.end(), instant - 1e-9) - times.begin());
    const int stride = std::max(1, step / 12);
    for (int k = middle - step; k <= middle + step; k += stride) at.insert(k);
    for (int k = middle - 3; k <= middle + 3; ++k) at.insert(k);
  }
  std::vector<double> instants;
  for (const int k : at) {
    if (k >= 2 && k + 2 < num) instants.push_back(times[static_cast<std::size_t>(k)]);
  }
  return instants;
}

std::vector<double> NearSettings(const LibraryOptions& options,
                                 const EffectRequest& place,
                                 const std::string& setting) {
  std::vector<double> values;
  for (EffectRequest member : options.near) {
    const auto found = member.settings.find(setting);
    if (member.effect != place.effect || found == member.settings.end()) continue;
    values.push_back(found->second);
  }
  return values;
}

std::vector<EffectRequest> WithSettings(const std::vector<EffectRequest>& places,
                                        const std::string& setting,
                                        const std::vector<double>& values) {
  std::vector<EffectRequest> requests;
  for (const EffectRequest& place : places) {
    for (const double value : values) {
      requests.push_back(place);
      requests.back().settings[setting] = value;
    }
  }
  return requests;
}

std::vector<EffectRequest> CurveForms(const PhysicsContext& c,
                                      const std::string& name,
                                      int num_poses) {
  std::vector<EffectRequest> forms;
  for (int joint = 0; joint < c.num_joints(); ++joint) {
    if (!c.revolute(joint)) continue;
    const double range = (c.q(joint).maxCoeff() - c.q(joint).minCoeff()) / kDegree;
    std::set<double> distances;
    for (const int knots : kCurveKnotsTried) {
      const int count = std::max(std::min(knots, num_poses / kPosesPerKnot), kFewestKnots);
      distances.insert(std::round(std::clamp(range / count, 3.0, 60.0) * 10) / 10);
    }
    for (const double distance : distances) {
      EffectRequest request;
      request.effect = name;
      request.joint = joint + 1;
      request.settings["knot_deg"] = distance;
      forms.push_back(request);
    }
  }
  return forms;
}

/// True if a cell that goes by the clock stands where an effect acts.
bool IsClocked(const PhysicsContext& c,
               const LibraryOptions& options,
               const Effect& effect,
               const EffectRequest& place) {
  const std::string at = place.joint > 0 ? c.slots().Name(c.joint_slot(place.joint - 1))
                                         : effect.Place(c, place).location;
  return std::any_of(options.clocked.begin(), options.clocked.end(), [&](const std::string& slot) {
    return slot == at || StartsWith(slot, at + " ");
  });
}

/// Places with a step at each of the instants tried there.
std::vector<EffectRequest> StepForms(const Effect& effect,
                                     const PhysicsContext& c,
                                     const LibraryOptions& options,
                                     const std::vector<EffectRequest>& places) {
  if (places.empty()) return {};
  const std::string step = StepSetting(c);
  const std::vector<double> near = NearSettings(options, places.front(), step);
  std::vector<EffectRequest> forms;
  for (const EffectRequest& place : places) {
    const int count = options.coarse                         ? kInstantsAtFirst
                      : IsClocked(c, options, effect, place) ? kInstantsOfAClockedPlace
                                                             : kInstantsTried;
    for (EffectRequest& form : WithSettings({place}, step, InstantsTried(c, count, near))) {
      forms.push_back(std::move(form));
    }
  }
  return forms;
}

/// All forms of one effect that are tried, testable or not.
std::vector<EffectRequest> FormsOf(const Effect& effect,
                                   const PhysicsContext& c,
                                   const LibraryOptions& options,
                                   const std::optional<GuessedLoads>& guessed) {
  const EffectDescription description = effect.Describe();
  if (description.is_curve) return CurveForms(c, description.name, options.num_poses);
  if (TakesSetting(effect, "driver_joint")) return AllPairs(c, description.name);
  std::vector<EffectRequest> requests = effect.Candidates(c);
  if (guessed && TakesSetting(effect, kMomentLink)) {
    const std::vector<EffectRequest> moments = WithMoments(c, *guessed, options.near, requests);
    requests.insert(requests.end(), moments.begin(), moments.end());
  }
  const std::string step = StepSetting(c);
  if (TakesSetting(effect, step)) return StepForms(effect, c, options, Places(requests, step));
  if (TakesSetting(effect, "time_constant_s") && c.has_time() && c.duration() > 0) {
    std::vector<EffectRequest> forms;
    for (const EffectRequest& request : requests) {
      if (request.settings.count("time_constant_s") == 0) forms.push_back(request);
    }
    const std::vector<EffectRequest> places = Places(requests, "time_constant_s");
    std::vector<double> constants;
    for (const double part : kTimeConstantsTried) constants.push_back(part * c.duration());
    const std::vector<EffectRequest> by_time = WithSettings(places, "time_constant_s", constants);
    forms.insert(forms.end(), by_time.begin(), by_time.end());
    return forms;
  }
  return requests;
}

bool MovesOnlyItsAngle(const PhysicsContext& c,
                       const EffectRequest& request,
                       const std::vector<EffectColumn>& columns) {
  if (request.joint == 0) return false;
  return std::all_of(columns.begin(), columns.end(), [&](const EffectColumn& column) {
    return std::all_of(column.slots.begin(), column.slots.end(), [&](const SlotWeights& w) {
      return w.slot == c.joint_slot(request.joint - 1);
    });
  });
}

/// What the choice of this form costs.
int VariantsOf(const PhysicsContext& c, const EffectRequest& request, int same_id) {
  if (request.settings.count("driver_joint") > 0) return std::max(1, c.num_joints() - 1);
  if (request.words.count(kColumn) > 0) {
    return std::max<int>(1, static_cast<int>(c.recording().extra.size()));
  }
  const double order = request.setting("order", 0);
  if (order > kHighestWholeOrder) return kOrdersOfAScan;
  if (order >= 4) return 7;
  if (order > 0) return 3;
  return std::min(same_id, kInstantsTried);
}

}  // namespace

std::vector<double> InstantsAround(const PhysicsContext& c, double instant, int rows) {
  const std::vector<double> times = Instants(c);
  const auto middle = static_cast<int>(
      std::lower_bound(times.begin(), times.end(), instant - 1e-9) - times.begin());
  std::vector<double> instants;
  for (int k = middle - rows; k <= middle + rows; ++k) {
    if (k < 1 || k >= static_cast<int>(times.size()) || k == middle) continue;
    instants.push_back(times[static_cast<std::size_t>(k)]);
  }
  return instants;
}

Item NamedItem(const PhysicsContext& c, const EffectRequest& request, int variants) {
  const Effect& effect = *FindEffect(request.effect);
  const std::vector<EffectColumn> columns = effect.Columns(c, request);
  Item item;
  item.request = request;
  item.request.values.clear();
  item.id = IdOf(request);
  item.counted_as = CountedAs(request);
  item.size = static_cast<int>(columns.size());
  item.variants = VariantsOf(c, request, variants);
  item.typical.resize(item.size);
  item.precision = Eigen::VectorXd::Zero(item.size);
  for (int k = 0; k < item.size; ++k) {
    const double spread = columns[static_cast<std::size_t>(k)].prior_sigma;
    item.typical[k] = columns[static_cast<std::size_t>(k)].typical;
    if (spread > 0) item.precision[k] = 1 / spread;
    item.positive.push_back(columns[static_cast<std::size_t>(k)].positive);
  }
  const EffectPlace place = effect.Place(c, request);
  item.elastic = place.driver == "gravity torque" || place.driver == "overturning moment";
  item.own_angle = place.driver == "joint angle" && MovesOnlyItsAngle(c, request, columns);
  item.taken_for = place.effect_class;
  return item;
}

std::vector<Item> NamedItems(const PhysicsContext& c, const LibraryOptions& options) {
  std::vector<Item> items;
  std::optional<GuessedLoads> guessed;  // where nobody stated masses
  if (!options.masses_given) guessed.emplace(c);
  for (const Effect* const effect : AllEffects()) {
    const EffectDescription description = effect->Describe();
    const auto& names = options.names;
    if (!names.empty() && std::find(names.begin(), names.end(), description.name) == names.end()) {
      continue;
    }
    if (!description.may_be_named) continue;
    if (description.of_head && !c.robot().head) continue;
    std::map<std::string, int> count;
    std::vector<EffectRequest> forms;
    for (const EffectRequest& request : FormsOf(*effect, c, options, guessed)) {
      const auto& on = options.switched;
      const bool active = std::any_of(on.begin(), on.end(), [&](const EffectRequest& e) {
        return e.effect == request.effect && e.joint == request.joint && !e.held &&
               IdOf(e) == IdOf(request);
      });
      if (active || !effect->NotTestable(c, request).empty()) continue;
      // Guessed masses have no shape fine enough for the cube of a torque.
      const bool fine = description.name == "torsion_nonlinearity";
      if (guessed && fine && request.setting("measured_torque", 0) == 0) continue;
      // Where a torque was measured, it is believed before a guessed mass.
      const bool guessed_load = guessed && request.setting("measured_torque", 0) == 0;
      const bool compliance = guessed_load && description.name == "joint_compliance";
      if (compliance && UsableTorque(c, *effect, request)) continue;
      const bool by_masses =
          request.setting("flank", 0) != 0 && request.setting(kMomentLink, 0) == 0;
      const bool rests_on_guess = compliance || (guessed_load && by_masses);
      const bool nothing_guessed = rests_on_guess && !guessed->tells(request.joint);
      if (nothing_guessed && !compliance) continue;
      forms.push_back(request);
      if (nothing_guessed) forms.back().settings["free_masses"] = 1;
      ++count[IdOf(request)];
    }
    for (const EffectRequest& request : forms) {
      Item item = NamedItem(c, request, count[IdOf(request)]);
      if (item.size > 0) items.push_back(std::move(item));
    }
  }
  return items;
}

}  // namespace dhcal
