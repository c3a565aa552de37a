#include "core/report/effect_list.h"

#include <fmt/format.h>

#include "core/physics/registry.h"
#include "core/report/format.h"

namespace dhcal {

std::string EffectList() {
  std::string text = Wrap(
      "",
      "Physical effects that a problem file can switch on (parameters.effects), put into a "
      "simulation (simulate.effects) and that the diagnosis looks for. Values are in SI units.");
  for (const Effect* const effect : AllEffects()) {
    const EffectDescription& d = effect->Describe();
    text += fmt::format("\n{}{}\n", d.name, d.has_joint ? "  (needs 'joint')" : "");
    text += Wrap("  ", d.summary);
    text += Wrap("  formula     ", d.formula);
    text += Wrap("  parameters  ", d.parameters);
    for (const EffectSetting& setting : d.settings) {
      text += Wrap("  setting     ", fmt::format("{}: {}", setting.name, setting.meaning));
    }
    text += Wrap("  needs       ", d.needs.empty() ? "joint angles only" : d.needs);
    text += Wrap("  usual size  ", d.typical);
  }
  return text;
}

}  // namespace dhcal
