#include "core/report/text_renderer.h"

#include <algorithm>
#include <string>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "core/base/text.h"
#include "core/report/format.h"
#include "core/report/text_layout.h"
#include "core/report/text_table.h"

namespace dhcal {
namespace {

/// "Caution: ", or "".
std::string Before(const std::string& label) { return label.empty() ? "" : label + " "; }

std::string Parts(const std::vector<ListItem>& parts, int indent) {
  std::string text;
  for (const ListItem& part : parts) {
    text += Wrap(Spaces(indent) + Before(part.label), part.text);
    text += Parts(part.parts, indent + kTextIndent);
  }
  return text;
}

/// What stands before the text of item `i`.
std::string Mark(const List& list, std::size_t i, int label_width) {
  std::string label = Before(list.items[i].label);
  switch (list.kind) {
    case List::Kind::kPlain:
      return label;
    case List::Kind::kBullets:
      return "- " + label;
    case List::Kind::kNumbers:
      return fmt::format("{:>2}. {}", i + 1, label);
    case List::Kind::kTerms:
      return label + Spaces(label_width - CountCharacters(label));
  }
  return "";
}

int LabelWidth(const List& list) {
  int width = 0;
  for (const ListItem& item : list.items) {
    width = std::max(width, CountCharacters(Before(item.label)));
  }
  return width;
}

std::string BlockText(const List& list) {
  const bool numbered = list.kind == List::Kind::kNumbers;
  const std::string gap = numbered ? "\n" : "";
  const int label_width = LabelWidth(list);
  std::string text = list.title.empty() ? "" : Wrap(Spaces(kTextIndent), list.title);
  for (std::size_t i = 0; i < list.items.size(); ++i) {
    if (i > 0) text += gap;
    const std::string first = Spaces(kTextIndent) + Mark(list, i, label_width);
    text += Wrap(first, list.items[i].text);
    text += Parts(list.items[i].parts, numbered ? CountCharacters(first) : 2 * kTextIndent);
  }
  if (list.left_out > 0) text += gap + Wrap(Spaces(kTextIndent), AndMore(list.left_out));
  return text;
}

std::string BlockText(const Paragraph& paragraph) {
  std::string text;
  for (std::size_t i = 0; i < paragraph.lines.size(); ++i) {
    const std::string first = Spaces(kTextIndent) + (i == 0 ? Before(paragraph.label) : "");
    text += Wrap(first, paragraph.lines[i]);
  }
  return text;
}

std::string BlockText(const Table& table) { return ToText(table); }

std::string BlockText(const Figure& /*figure*/) { return ""; }

/// Title on the left, program on the right, underlined.
std::string Head(const Document& document) {
  constexpr int kMostOfProgram = 32;
  const std::string program = Clip(document.program, kMostOfProgram);
  const std::string title =
      Clip(document.title, kReportWidth - CountCharacters(program) - kTextIndent);
  const int gap = kReportWidth - CountCharacters(title) - CountCharacters(program);
  return title + Spaces(gap) + program + "\n" + std::string(kReportWidth, '=') + "\n";
}

}  // namespace

std::string ToText(const Section& section) {
  std::string text;
  for (const Block& block : section.blocks) {
    const std::string own =
        std::visit([](const auto& alternative) { return BlockText(alternative); }, block);
    if (!own.empty()) text += "\n" + own;
  }
  // A section of figures alone says nothing here.
  return text.empty() || section.title.empty() ? text : "\n" + section.title + "\n" + text;
}

std::string ToText(const Document& document) {
  std::string text = Head(document);
  for (const Section& section : document.sections) text += ToText(section);
  return text;
}

}  // namespace dhcal
