// core/physics/PHYSICS.md as the tests read it: its sections, and its table of effects.
#ifndef DHCAL_TESTS_CORE_PHYSICS_PHYSICS_PAGE_H_
#define DHCAL_TESTS_CORE_PHYSICS_PHYSICS_PAGE_H_

#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>

namespace dhcal {

/// All matches of `pattern`'s first group in `text`.
inline std::set<std::string> AllMatches(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern);
  std::set<std::string> found;
  for (std::sregex_iterator match(text.begin(), text.end(), regex), end; match != end; ++match) {
    found.insert((*match)[1]);
  }
  return found;
}

/// Labels behind the page's name, ranges spelled out: {"G1", "G2", "G3"} of "... [PHYSICS.md
/// G1-G3]".
inline std::set<std::string> CitedSections(const std::string& text) {
  std::smatch match;
  if (!std::regex_search(text, match, std::regex(R"(\[PHYSICS\.md ([^\]]+)\])"))) return {};
  const std::string cited = match[1];
  std::set<std::string> labels = AllMatches(cited, R"(([A-Z][0-9]+))");
  std::smatch range;
  if (std::regex_search(cited, range, std::regex(R"(([A-Z])([0-9]+)-[A-Z]([0-9]+))"))) {
    for (int n = std::stoi(range[2]); n <= std::stoi(range[3]); ++n) {
      labels.insert(range[1].str() + std::to_string(n));
    }
  }
  return labels;
}

/// What the page says of one effect in its table.
struct PhysicsRow {
  std::set<std::string> sections;  // {"G1", "G2", "G3"}
  std::set<std::string> classes;   // {"C2", "C3", "C8"}
};

class PhysicsPage {
 public:
  PhysicsPage() {
    std::ifstream file(DHCAL_SOURCE_DIR "/core/physics/PHYSICS.md");
    text_.assign(std::istreambuf_iterator<char>(file), {});
    sections_ = AllMatches(text_, R"(\n### ([A-Z][0-9]+) )");
  }

  bool HasSection(const std::string& label) const { return sections_.count(label) > 0; }

  /// Empty sets when the table has no such effect.
  PhysicsRow Row(const std::string& effect) const {
    std::smatch match;
    const std::regex row("`" + effect + R"(` \| ([^|]*) \| ([^|]*) \|)");
    if (!std::regex_search(text_, match, row)) return {};
    const std::string words = R"(([A-Za-z0-9]+))";
    return {AllMatches(match[1], words), AllMatches(match[2], words)};
  }

 private:
  std::string text_;
  std::set<std::string> sections_;
};

}  // namespace dhcal

#endif  // DHCAL_TESTS_CORE_PHYSICS_PHYSICS_PAGE_H_
