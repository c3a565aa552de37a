#include "core/report/html/plot_svg.h"

#include <chrono>
#include <cstddef>
#include <locale>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/text.h"
#include "core/io/process.h"
#include "core/report/html/plot_script.h"

namespace dhcal {
namespace {

constexpr std::chrono::seconds kPatience(20);  // usual is below one
constexpr char kEndOfDrawing[] = "</svg>";

void ReplaceAll(const std::string& what, const std::string& with, std::string* text) {
  for (std::size_t at = text->find(what); at != std::string::npos;
       at = text->find(what, at + with.size())) {
    text->replace(at, what.size(), with);
  }
}

/// "rgb(1,2,10)", also with blanks, -> "var(--ink-10)".
std::string WithInks(const std::string& svg) {
  static const std::string kColour = "rgb(";
  std::string text;
  std::size_t done = 0;
  for (std::size_t at = svg.find(kColour); at != std::string::npos; at = svg.find(kColour, done)) {
    const std::size_t end = svg.find(')', at);
    if (end == std::string::npos) break;
    std::istringstream numbers(svg.substr(at + kColour.size(), end - at - kColour.size()));
    numbers.imbue(std::locale::classic());
    int red = 0, green = 0, blue = 0;
    char comma = ',';
    numbers >> red >> comma >> green >> comma >> blue;
    const bool is_ink = numbers && red == kInkRed && green == kInkGreen;
    text.append(svg, done, at - done);
    text += is_ink ? fmt::format("var(--ink-{})", blue) : svg.substr(at, end + 1 - at);
    done = end + 1;
  }
  return text.append(svg, done, std::string::npos);
}

/// Without groups that hold nothing, of which gnuplot writes many, and without titles, which
/// browsers show where the mouse stands.
std::string WithoutIdleLines(const std::string& svg) {
  std::vector<std::string> kept;
  std::istringstream lines(svg);
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || StartsWith(line, "<title>") || StartsWith(line, "<desc>")) continue;
    const std::size_t title = line.find("<title>");
    if (title != std::string::npos) line.erase(title);
    if (line == "</g>" && !kept.empty() && StartsWith(kept.back(), "<g ")) {
      kept.pop_back();
      continue;
    }
    kept.push_back(std::move(line));
  }
  return fmt::format("{}\n", fmt::join(kept, "\n"));
}

/// A round point of gnuplot's: "\t<use xlink:href='#gpPt6' transform='translate(59.15,128.55)
/// scale(1.95)' color='...'/>".
struct Dot {
  std::string place;   // "59.15,128.55"
  double radius = 0;   // [px]
  std::string colour;  // as it stands in the quotes
};

/// What stands in `line` between `before` and the next `after`; "" where they are not there.
std::string Between(const std::string& line, const std::string& before, char after) {
  const std::size_t start = line.find(before);
  if (start == std::string::npos) return "";
  const std::size_t end = line.find(after, start + before.size());
  return end == std::string::npos ? ""
                                  : line.substr(start + before.size(), end - start - before.size());
}

std::optional<Dot> AsDot(const std::string& line) {
  if (line.find("href='#gpPt6' transform=") == std::string::npos) return std::nullopt;
  const std::optional<double> radius = ParseDouble(Between(line, "scale(", ')'));
  Dot dot{Between(line, "translate(", ')'), radius.value_or(0), Between(line, "color='", '\'')};
  if (!radius || dot.place.empty() || dot.colour.empty()) return std::nullopt;
  return dot;
}

/// Points that follow each other as one line of strokes without length, whose round ends are the
/// points: a seventh of the characters.
std::string WithDotsAsPaths(const std::string& svg) {
  std::string text;
  std::optional<Dot> last;
  std::istringstream lines(svg);
  for (std::string line; std::getline(lines, line);) {
    const std::optional<Dot> dot = AsDot(line);
    const bool goes_on = dot && last && dot->radius == last->radius && dot->colour == last->colour;
    if (last && !goes_on) text += "'/>\n";
    if (!dot) {
      text += line + "\n";
    } else {
      if (!goes_on) {
        text += fmt::format("<path stroke='{}' stroke-width='{:g}' stroke-linecap='round' d='",
                            dot->colour,
                            2 * dot->radius);
      }
      text += fmt::format("M{}h0", dot->place);
    }
    last = dot;
  }
  return last ? text + "'/>\n" : text;
}

std::string WhyNotDrawn(ProcessOutput::End end) {
  switch (end) {
    case ProcessOutput::End::kNotFound:
      return "Plots are missing: they need gnuplot, which is not installed (apt-get install "
             "gnuplot-nox). Run the program again then; the data of the plots is here.";
    case ProcessOutput::End::kTimeOut:
      return "Plots are missing: gnuplot took too long and was ended. The data of the plots is "
             "here.";
    case ProcessOutput::End::kFailed:
    case ProcessOutput::End::kDone:
      break;
  }
  return "Plots are missing: gnuplot failed (5.2 or newer is needed; gnuplot --version tells). The "
         "data of the plots is here.";
}

}  // namespace

std::string AsPageElement(const std::string& svg, const std::string& prefix) {
  const std::size_t start = svg.find("<svg");
  if (start == std::string::npos) return "";
  std::string text = WithDotsAsPaths(WithoutIdleLines(WithInks(svg.substr(start))));
  for (const char* const reference : {"id='", "id=\"", "href='#", "url(#"}) {
    ReplaceAll(reference, reference + prefix, &text);
  }
  for (const char* const mark : {"color=\"", "color='", "fill=\"", "stroke=\""}) {
    ReplaceAll(mark + std::string("black"), mark + std::string("var(--ink-10)"), &text);
    ReplaceAll(mark + std::string("white"), mark + std::string("var(--paper)"), &text);
  }
  return text;
}

DrawnPlots DrawPlots(const std::vector<Plot>& plots) {
  DrawnPlots drawn;
  if (plots.empty()) return drawn;
  std::string script;
  for (const Plot& plot : plots) script += GnuplotScript(plot);
  // -d: without the user's own settings.
  const ProcessOutput output = RunForOutput({"gnuplot", "-d", "-"}, script, kPatience);
  std::size_t start = 0;
  for (std::size_t end = output.text.find(kEndOfDrawing); end != std::string::npos;
       end = output.text.find(kEndOfDrawing, start)) {
    end += sizeof(kEndOfDrawing) - 1;
    const std::string prefix = fmt::format("p{}-", drawn.svg.size() + 1);
    drawn.svg.push_back(AsPageElement(output.text.substr(start, end - start), prefix));
    start = end;
  }
  if (drawn.svg.size() == plots.size()) return drawn;
  return {std::vector<std::string>(plots.size()), WhyNotDrawn(output.end)};
}

}  // namespace dhcal
