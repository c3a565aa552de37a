// The library of physical effects as a page of text.
#ifndef DHCAL_CORE_REPORT_EFFECT_LIST_H_
#define DHCAL_CORE_REPORT_EFFECT_LIST_H_

#include <string>

namespace dhcal {

/// Each effect with its formula, parameters with units, settings, needed columns and usual size.
std::string EffectList();

}  // namespace dhcal

#endif  // DHCAL_CORE_REPORT_EFFECT_LIST_H_
