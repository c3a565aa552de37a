// Whether the tests run under a sanitizer, many times slower.
#ifndef DHCAL_TESTS_SUPPORT_SANITIZED_H_
#define DHCAL_TESTS_SUPPORT_SANITIZED_H_

namespace dhcal {

#if defined(DHCAL_SANITIZED)
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

}  // namespace dhcal

#endif  // DHCAL_TESTS_SUPPORT_SANITIZED_H_
