// Text and data inside a page.
#ifndef DHCAL_CORE_REPORT_HTML_HTML_TEXT_H_
#define DHCAL_CORE_REPORT_HTML_HTML_TEXT_H_

#include <string>
#include <string_view>

namespace dhcal {

/// Fit to stand anywhere in a page, in an attribute's quotes, too: markup is escaped, bytes that
/// are not UTF-8 become U+FFFD, control characters blanks.
std::string Escaped(std::string_view text);

std::string Base64(std::string_view bytes);

/// "UNMODELLED EFFECTS: EXPLAINED" -> "Unmodelled effects: explained".
std::string InSentenceCase(std::string_view title);

}  // namespace dhcal

#endif  // DHCAL_CORE_REPORT_HTML_HTML_TEXT_H_
