// The parts of a report as elements of a page.
#ifndef DHCAL_CORE_REPORT_HTML_HTML_BLOCKS_H_
#define DHCAL_CORE_REPORT_HTML_HTML_BLOCKS_H_

#include <string>
#include <vector>

#include "core/report/document.h"

namespace dhcal {

std::string ToHtml(const Paragraph& paragraph);
std::string ToHtml(const List& list);
std::string ToHtml(const Table& table);

/// `svg`: its plots' drawings, or empty texts; `number` counts the figures of the page from 1.
std::string ToHtml(const Figure& figure, const std::vector<std::string>& svg, int number);

}  // namespace dhcal

#endif  // DHCAL_CORE_REPORT_HTML_HTML_BLOCKS_H_
