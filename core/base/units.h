// The only conversions there are: SI inside, degrees and millimetres at the edges (io, report).
#ifndef DHCAL_CORE_BASE_UNITS_H_
#define DHCAL_CORE_BASE_UNITS_H_

namespace dhcal {

constexpr double kPi = 3.14159265358979323846;
constexpr double kDegree = kPi / 180.0;  // [rad]
constexpr double kMillimetre = 1e-3;     // [m]
constexpr double kMicrometre = 1e-6;     // [m]
constexpr double kMilliradian = 1e-3;    // [rad]

}  // namespace dhcal

#endif  // DHCAL_CORE_BASE_UNITS_H_
