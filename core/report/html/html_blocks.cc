#include "core/report/html/html_blocks.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/report/format.h"
#include "core/report/html/figure_csv.h"
#include "core/report/html/html_text.h"

namespace dhcal {
namespace {

std::string Labelled(const std::string& label, const std::string& text) {
  return label.empty() ? Escaped(text) : fmt::format("<b>{}</b> {}", Escaped(label), Escaped(text));
}

std::string PartsHtml(const std::vector<ListItem>& parts) {
  if (parts.empty()) return "";
  std::string text = "<ul class=\"parts\">\n";
  for (const ListItem& part : parts) {
    text += fmt::format("<li>{}{}</li>\n", Labelled(part.label, part.text), PartsHtml(part.parts));
  }
  return text + "</ul>\n";
}

/// Labels beside their texts; an entry without a label goes on with the one before.
std::string TermsHtml(const List& list) {
  std::string text = "<dl>\n";
  for (const ListItem& item : list.items) {
    text += fmt::format("<dt>{}</dt><dd>{}{}</dd>\n",
                        Escaped(item.label),
                        Escaped(item.text),
                        PartsHtml(item.parts));
  }
  return text + "</dl>\n";
}

std::string ItemsHtml(const List& list) {
  const bool numbers = list.kind == List::Kind::kNumbers;
  const bool plain = list.kind == List::Kind::kPlain;
  std::string text = numbers ? "<ol>\n" : plain ? "<ul class=\"parts\">\n" : "<ul>\n";
  for (const ListItem& item : list.items) {
    text += fmt::format("<li>{}{}</li>\n", Labelled(item.label, item.text), PartsHtml(item.parts));
  }
  return text + (numbers ? "</ol>\n" : "</ul>\n");
}

std::size_t DigitsAfterPoint(const std::string& cell) {
  const std::size_t point = cell.find('.');
  return point == std::string::npos ? 0 : cell.size() - point - 1;
}

/// The most digits behind a point in each column.
std::vector<std::size_t> MostDigits(const Table& table) {
  std::vector<std::size_t> most(table.columns.size(), 0);
  for (const Table::Row& row : table.rows) {
    for (std::size_t c = 0; c < row.cells.size() && c < most.size(); ++c) {
      most[c] = std::max(most[c], DigitsAfterPoint(row.cells[c]));
    }
  }
  return most;
}

/// Blanks of the width of digits and of a point, so that points stand one under the other.
std::string PointPadding(const std::string& cell, std::size_t most_digits) {
  constexpr char kFigureSpace[] = "&#8199;", kPointSpace[] = "&#8200;";
  if (cell.find_first_of("0123456789") == std::string::npos) return "";
  const std::size_t digits = DigitsAfterPoint(cell);
  std::string padding = digits == 0 && most_digits > 0 ? kPointSpace : "";
  for (std::size_t i = digits; i < most_digits; ++i) padding += kFigureSpace;
  return padding;
}

const char* ClassOf(const Table::Column& column) {
  return column.align == Table::Align::kLeft ? " class=\"words\"" : "";
}

std::string HeadHtml(const Table& table) {
  std::string text = "<thead><tr>";
  for (const Table::Column& column : table.columns) {
    text += fmt::format("<th scope=\"col\"{}>{}", ClassOf(column), Escaped(column.title));
    if (!column.unit.empty()) text += fmt::format(" <small>[{}]</small>", Escaped(column.unit));
    text += "</th>";
  }
  return text + "</tr></thead>\n";
}

std::string RowHtml(const Table& table,
                    const Table::Row& row,
                    const std::vector<std::size_t>& most_digits) {
  if (row.left_out > 0) {
    return fmt::format("<tr><td class=\"words more\" colspan=\"{}\">{}</td></tr>\n",
                       table.columns.size(),
                       Escaped(AndMore(row.left_out)));
  }
  std::string text = "<tr>";
  for (std::size_t c = 0; c < row.cells.size() && c < table.columns.size(); ++c) {
    const bool point = table.columns[c].align == Table::Align::kPoint;
    text += fmt::format("<td{}>{}{}</td>",
                        ClassOf(table.columns[c]),
                        Escaped(row.cells[c]),
                        point ? PointPadding(row.cells[c], most_digits[c]) : "");
  }
  return text + "</tr>\n";
}

}  // namespace

std::string ToHtml(const Paragraph& paragraph) {
  std::string text;
  for (std::size_t i = 0; i < paragraph.lines.size(); ++i) {
    text += fmt::format("<p>{}</p>\n", Labelled(i == 0 ? paragraph.label : "", paragraph.lines[i]));
  }
  return text;
}

std::string ToHtml(const List& list) {
  std::string text = list.title.empty() ? "" : fmt::format("<p>{}</p>\n", Escaped(list.title));
  text += list.kind == List::Kind::kTerms ? TermsHtml(list) : ItemsHtml(list);
  if (list.left_out > 0) {
    text += fmt::format("<p class=\"more\">{}</p>\n", Escaped(AndMore(list.left_out)));
  }
  return text;
}

std::string ToHtml(const Table& table) {
  std::string text = "<div class=\"table\" tabindex=\"0\"><table>\n";
  if (!table.title.empty()) text += fmt::format("<caption>{}</caption>\n", Escaped(table.title));
  text += HeadHtml(table) + "<tbody>\n";
  const std::vector<std::size_t> most_digits = MostDigits(table);
  for (const Table::Row& row : table.rows) text += RowHtml(table, row, most_digits);
  return text + "</tbody></table></div>\n";
}

std::string ToHtml(const Figure& figure, const std::vector<std::string>& svg, int number) {
  const std::size_t count = figure.plots.size();
  std::string text = fmt::format("<figure id=\"figure-{}\">\n", number);
  if (std::any_of(svg.begin(), svg.end(), [](const std::string& s) { return !s.empty(); })) {
    text += fmt::format("<div class=\"plots{}\" role=\"img\" aria-label=\"{}\">\n",
                        count == 1   ? " one"
                        : count == 2 ? " two"
                                     : "",
                        Escaped(figure.caption));
    for (const std::string& drawing : svg) text += drawing;
    text += "</div>\n";
  }
  return text +
         fmt::format(
             "<figcaption><b>Figure {0}.</b> {1} <a class=\"data\" download=\"figure_{0}.csv\" "
             "href=\"data:text/csv;charset=utf-8;base64,{2}\">Data (CSV)</a></figcaption>\n"
             "</figure>\n",
             number,
             Escaped(figure.caption),
             Base64(FigureCsv(figure)));
}

}  // namespace dhcal
