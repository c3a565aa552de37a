#include "core/report/html/html_renderer.h"

#include <cstddef>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "core/report/html/html_blocks.h"
#include "core/report/html/html_style.h"
#include "core/report/html/html_text.h"
#include "core/report/html/plot_svg.h"

namespace dhcal {
namespace {

/// All plots, in the order in which they stand in the page.
std::vector<Plot> PlotsOf(const Document& document) {
  std::vector<Plot> plots;
  for (const std::vector<Section>* const sections : {&document.answer, &document.sections}) {
    for (const Section& section : *sections) {
      for (const Block& block : section.blocks) {
        const auto* const figure = std::get_if<Figure>(&block);
        if (figure == nullptr) continue;
        plots.insert(plots.end(), figure->plots.begin(), figure->plots.end());
      }
    }
  }
  return plots;
}

/// Renders sections one after the other and hands each figure its drawings.
class PageSections {
 public:
  explicit PageSections(DrawnPlots drawn) : drawn_(std::move(drawn)) {}

  std::string Html(const Section& section, const std::string& id) {
    std::string text = fmt::format("<section id=\"{}\">\n", id);
    if (!section.title.empty()) {
      text += fmt::format("<h2>{}</h2>\n", Escaped(InSentenceCase(section.title)));
    }
    for (const Block& block : section.blocks) {
      text += std::visit([this](const auto& one) { return BlockHtml(one); }, block);
    }
    return text + "</section>\n";
  }

 private:
  template <typename TextBlock>
  std::string BlockHtml(const TextBlock& block) {
    return ToHtml(block);
  }
  std::string BlockHtml(const Figure& figure) {
    std::vector<std::string> svg;
    for (std::size_t i = 0; i < figure.plots.size(); ++i) {
      svg.push_back(std::move(drawn_.svg[next_plot_++]));
    }
    return ToHtml(figure, svg, ++figures_);
  }

  DrawnPlots drawn_;
  std::size_t next_plot_ = 0;
  int figures_ = 0;
};

std::string SectionId(std::size_t idx) { return fmt::format("section-{}", idx + 1); }

std::string Contents(const std::vector<Section>& sections) {
  std::string text = "<nav aria-label=\"Contents\"><ul>\n";
  for (std::size_t i = 0; i < sections.size(); ++i) {
    if (sections[i].title.empty()) continue;
    text += fmt::format("<li><a href=\"#{}\">{}</a></li>\n",
                        SectionId(i),
                        Escaped(InSentenceCase(sections[i].title)));
  }
  return text + "</ul></nav>\n";
}

/// What browsers need to know. The policy forbids every request: all is in the file.
std::string PageHead(const Document& document) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src "
      "'unsafe-inline'; img-src data:\">\n"
      "<link rel=\"icon\" href=\"data:,\">\n<title>{}</title>\n<style>{}</style>\n</head>\n",
      Escaped(document.title),
      kHtmlStyle);
}

}  // namespace

std::string ToHtml(const Document& document) {
  DrawnPlots drawn = DrawPlots(PlotsOf(document));
  const std::string why_not = drawn.why_not;
  PageSections sections(std::move(drawn));
  std::string text = PageHead(document);
  text += fmt::format("<body>\n<header>\n<h1>{}</h1>\n<p class=\"program\">{}</p>\n</header>\n",
                      Escaped(document.title),
                      Escaped(document.program));
  text += "<main>\n<div class=\"answer\">\n";
  for (std::size_t i = 0; i < document.answer.size(); ++i) {
    text += sections.Html(document.answer[i], fmt::format("answer-{}", i + 1));
  }
  text += "</div>\n" + Contents(document.sections);
  if (!why_not.empty()) text += fmt::format("<p class=\"notice\">{}</p>\n", Escaped(why_not));
  for (std::size_t i = 0; i < document.sections.size(); ++i) {
    text += sections.Html(document.sections[i], SectionId(i));
  }
  return text + "</main>\n</body>\n</html>\n";
}

}  // namespace dhcal
