// A second renderer of the report: Markdown. All that a further form of the report takes is a file
// like this one, and a line in ReportFormats() where the program is to write it.
#ifndef DHCAL_TESTS_CORE_REPORT_MARKDOWN_RENDERER_H_
#define DHCAL_TESTS_CORE_REPORT_MARKDOWN_RENDERER_H_

#include <string>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/report/document.h"
#include "core/report/format.h"

namespace dhcal {

class MarkdownRenderer {
 public:
  std::string operator()(const Document& document) const {
    std::string text = fmt::format("# {}\n\n{}\n", Plain(document.title), Plain(document.program));
    for (const Section& section : document.sections) {
      if (!section.title.empty()) text += fmt::format("\n## {}\n", Plain(section.title));
      for (const Block& block : section.blocks) {
        text += "\n" + std::visit([this](const auto& one) { return BlockText(one); }, block);
      }
    }
    return text;
  }

 private:
  /// Without what Markdown would take for markup.
  static std::string Plain(const std::string& text) {
    std::string plain;
    for (const char c : text) {
      if (c == '|' || c == '*' || c == '_' || c == '<' || c == '[' || c == '#') plain += '\\';
      plain += c == '\n' ? ' ' : c;
    }
    return plain;
  }

  static std::string Labelled(const std::string& label, const std::string& text) {
    return label.empty() ? Plain(text) : fmt::format("**{}** {}", Plain(label), Plain(text));
  }

  std::string BlockText(const Paragraph& paragraph) const {
    std::string text;
    for (std::size_t i = 0; i < paragraph.lines.size(); ++i) {
      text += Labelled(i == 0 ? paragraph.label : "", paragraph.lines[i]) + "  \n";
    }
    return text;
  }

  std::string Items(const std::vector<ListItem>& items, const char* mark, int indent) const {
    std::string text;
    for (const ListItem& item : items) {
      text += fmt::format("{:{}}{} {}\n", "", indent, mark, Labelled(item.label, item.text));
      text += Items(item.parts, "-", indent + 3);
    }
    return text;
  }

  std::string BlockText(const List& list) const {
    std::string text = list.title.empty() ? "" : Plain(list.title) + "\n\n";
    text += Items(list.items, list.kind == List::Kind::kNumbers ? "1." : "-", 0);
    if (list.left_out > 0) text += "\n" + AndMore(list.left_out) + "\n";
    return text;
  }

  static std::string Row(const std::vector<std::string>& cells) {
    return fmt::format("| {} |\n", fmt::join(cells, " | "));
  }

  std::string BlockText(const Table& table) const {
    std::vector<std::string> titles, rules;
    for (const Table::Column& column : table.columns) {
      const std::string unit = column.unit.empty() ? "" : fmt::format(" [{}]", column.unit);
      titles.push_back(Plain(column.title + unit));
      rules.emplace_back(column.align == Table::Align::kLeft ? ":--" : "--:");
    }
    std::string text = table.title.empty() ? "" : Plain(table.title) + "\n\n";
    text += Row(titles) + Row(rules);
    for (const Table::Row& row : table.rows) {
      std::vector<std::string> cells;
      for (const std::string& cell : row.cells) cells.push_back(Plain(cell));
      if (cells.empty()) cells = {AndMore(row.left_out)};
      cells.resize(table.columns.size());
      text += Row(cells);
    }
    return text;
  }

  static std::string AxisText(const Plot::Axis& axis) {
    const std::string unit = axis.unit.empty() ? "" : fmt::format(" [{}]", axis.unit);
    return Plain(axis.title + unit + (axis.logarithmic ? ", logarithmic" : ""));
  }

  static std::string PlotText(const Plot& plot) {
    std::string text = fmt::format("{} against {}\n", AxisText(plot.y), AxisText(plot.x));
    for (const Plot::Series& series : plot.series) {
      text += fmt::format("\n    {}\n", series.name);
      for (std::size_t i = 0; i < series.x.size(); ++i) {
        text += fmt::format("    {:g} {:g}", series.x[i], series.y[i]);
        text += series.sigma.empty() ? "\n" : fmt::format(" {:g}\n", series.sigma[i]);
      }
    }
    for (const Plot::Level& level : plot.levels) {
      text += fmt::format("\n    {} {:g}\n", level.name, level.y);
    }
    return text;
  }

  /// Markdown cannot draw: the caption, and what a plotting program needs.
  std::string BlockText(const Figure& figure) const {
    std::string text = fmt::format("*Figure.* {}  \n", Plain(figure.caption));
    for (const Plot& plot : figure.plots) text += PlotText(plot);
    return text;
  }
};

}  // namespace dhcal

#endif  // DHCAL_TESTS_CORE_REPORT_MARKDOWN_RENDERER_H_
