// What is wrong with the files, or odd about them, and the lines that cure it.
#include <string>

#include <fmt/format.h>

#include "core/report/sections.h"

namespace dhcal {
namespace {

/// "kr15.yaml:12: sign: -1", without what is not known.
std::string FixText(const SetupCause& cause) {
  if (cause.text.empty()) return "";
  const std::string where = cause.where.ToString();
  return where.empty() ? cause.text : where + ": " + cause.text;
}

ListItem Item(const SetupCause& cause) {
  ListItem item{cause.sentence, "", {}};
  const std::string fix = FixText(cause);
  if (!fix.empty()) item.parts.push_back({fix, "Write", {}});
  return item;
}

void AddAlternative(const Result& result, int alternative, int count, Section* section) {
  List list;
  list.kind = List::Kind::kBullets;
  if (count > 1) list.title = fmt::format("Possibility {} of {}", alternative, count);
  for (const SetupCause& cause : result.setup.causes) {
    if (cause.alternative == alternative) list.items.push_back(Item(cause));
  }
  section->blocks.push_back(list);
}

std::string Introduction(const SetupResult& setup, int alternatives) {
  if (setup.cured) return "The files were read as if they had been corrected so:";
  if (alternatives > 1) {
    return "One of these is wrong in the files, and base and tool hide which:";
  }
  return setup.causes.size() > 1 ? "These are wrong in the files:" : "What is wrong in the files:";
}

}  // namespace

Section SetupSection(const Result& result) {
  const SetupResult& setup = result.setup;
  Section section{setup.plausible ? "SET-UP" : "IMPLAUSIBLE", {}};
  if (!setup.plausible) {
    Paragraph reasons{setup.reasons, ""};
    reasons.lines.emplace_back("So nothing is delivered that could be taken for a calibration.");
    section.blocks.emplace_back(reasons);
  }
  if (!setup.causes.empty()) {
    const int alternatives = setup.causes.back().alternative;
    section.blocks.push_back(Paragraph{{Introduction(setup, alternatives)}, ""});
    for (int k = 1; k <= alternatives; ++k) AddAlternative(result, k, alternatives, &section);
    if (!setup.cured && !setup.plausible && alternatives == 1) {
      section.blocks.push_back(Paragraph{
          {"With --try_fix the program runs on as if the files had been corrected."}, ""});
    }
  }
  if (!setup.remarks.empty()) {
    List remarks;
    remarks.kind = List::Kind::kBullets;
    for (const std::string& remark : setup.remarks) remarks.items.push_back({remark, "", {}});
    section.blocks.emplace_back(remarks);
  }
  return section.blocks.empty() ? Section() : section;
}

}  // namespace dhcal
