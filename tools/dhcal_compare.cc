// dhcal_compare: two results side by side.
#include <exception>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/base/quiet_log.h"
#include "core/base/text.h"
#include "core/io/whole_file.h"
#include "core/report/html/html_renderer.h"
#include "core/report/text_renderer.h"
#include "tools/compare/comparison_report.h"

namespace dhcal {
namespace {

constexpr int kOk = 0, kBadInput = 2;

constexpr char kHelp[] =
    R"(dhcal_compare: two result folders of ceres_dhcal side by side.

  dhcal_compare A B [--html FILE]

Prints which predicts rows better that were not fitted, what moved between A and B and by how many
sigmas, and which effects either has.

  --html FILE       write the comparison as one page for a browser, too
  --version, --help

Exit status: 0 compared, 2 bad input.
)";

struct CompareOptions {
  std::vector<std::string> folders;
  std::string html;
};

std::optional<CompareOptions> Parse(const std::vector<std::string>& words) {
  CompareOptions options;
  for (std::size_t k = 0; k < words.size(); ++k) {
    if (words[k] == "--html" && k + 1 < words.size()) {
      options.html = words[++k];
    } else if (StartsWith(words[k], "--html=")) {
      options.html = words[k].substr(7);
    } else if (StartsWith(words[k], "-")) {
      return std::nullopt;
    } else {
      options.folders.push_back(words[k]);
    }
  }
  if (options.folders.size() != 2) return std::nullopt;
  return options;
}

int Compare(const CompareOptions& options) {
  Diagnostics diagnostics;
  const std::optional<ReadResult> a = ReadResultFolder(options.folders[0], &diagnostics);
  const std::optional<ReadResult> b = ReadResultFolder(options.folders[1], &diagnostics);
  if (a && b) {
    const Document document = ComparisonReport(*a, *b);
    if (options.html.empty() || WriteWholeFile(options.html, ToHtml(document), &diagnostics)) {
      std::cout << ToText(document) << std::flush;
    }
  }
  std::cerr << diagnostics.ToString();
  return diagnostics.ok() ? kOk : kBadInput;
}

int Main(const std::vector<std::string>& words) {
  for (const std::string& word : words) {
    if (word == "--help" || word == "--version") {
      std::cout << (word == "--help" ? kHelp : "dhcal_compare " DHCAL_VERSION "\n");
      return kOk;
    }
  }
  const std::optional<CompareOptions> options = Parse(words);
  if (!options) {
    std::cerr << "usage: dhcal_compare A B [--html FILE], two result folders; see --help\n";
    return kBadInput;
  }
  return Compare(*options);
}

}  // namespace
}  // namespace dhcal

int main(int argc, char** argv) {
  dhcal::StartQuietLog(argv[0]);
  try {
    return dhcal::Main({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::cerr << "dhcal_compare: internal error: " << error.what() << "\n";
    return dhcal::kBadInput;
  }
}
