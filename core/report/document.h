// A report as data: what is said, in which order, and what each number is. How it looks is the
// matter of a renderer, such as core/report/text_renderer.h; none needs to know a Result.
#ifndef DHCAL_CORE_REPORT_DOCUMENT_H_
#define DHCAL_CORE_REPORT_DOCUMENT_H_

#include <cstddef>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace dhcal {

/// Sentences that belong together. Each line begins anew and may be longer than a page is wide.
struct Paragraph {
  std::vector<std::string> lines;
  std::string label;  // stands before the first line: "Not explained:"; may be empty
};

/// An entry of a list, and what is said below it.
struct ListItem {
  std::string text;
  std::string label;            // stands before the text: "Caution:"; may be empty
  std::vector<ListItem> parts;  // below the text, in the manner of List::Kind::kPlain
};

struct List {
  enum class Kind {
    kPlain,
    kBullets,
    kNumbers,  // counted from 1; the text may refer to an entry by its number
    kTerms,    // label and text side by side
  };
  Kind kind = Kind::kPlain;
  std::string title;  // may be empty
  std::vector<ListItem> items;
  std::size_t left_out = 0;  // further entries, which stand only in result.json
};

/// Cells are text: how many digits of a number mean something is known where the table is made.
struct Table {
  enum class Align {
    kLeft,
    kRight,
    kPoint,  // decimal points one under the other
  };
  struct Column {
    std::string title;
    std::string unit;    // of the cells' numbers: "mm"; empty = none, or words
    int max_width = 12;  // [characters] where room is short, longer cells may lose their middle
    Align align = Align::kRight;
  };
  struct Row {
    std::vector<std::string> cells;  // one per column; none = rows that were left out
    std::size_t left_out = 0;        // how many; they stand only in result.json
  };

  void AddRow(std::vector<std::string> cells) { rows.push_back({std::move(cells), 0}); }
  void AddLeftOut(std::size_t count) { rows.push_back({{}, count}); }

  std::string title;  // may be empty
  std::vector<Column> columns;
  std::vector<Row> rows;
};

/// Numbers to be drawn. Its caption says what they show; what a reader must know of them stands in
/// the text, too, for renderers that cannot draw.
struct Figure {
  struct Axis {
    std::string title;
    std::string unit;          // of the numbers: "m"; empty = none
    bool logarithmic = false;  // all numbers on it are above zero
  };
  /// Points in order, all finite.
  struct Series {
    std::string name;
    std::vector<double> x, y;
    std::vector<double> sigma;  // of y, one standard deviation each; empty = not known
  };
  /// A line across at one y.
  struct Level {
    std::string name;
    double y = 0;
  };

  std::string caption;  // one sentence
  Axis x, y;
  std::vector<Series> series;
  std::vector<Level> levels;
};

using Block = std::variant<Paragraph, List, Table, Figure>;

struct Section {
  std::string title;  // may be empty
  std::vector<Block> blocks;

  /// True when it has nothing to say.
  bool empty() const { return blocks.empty(); }
};

struct Document {
  std::string title;
  std::string program;  // that made it, with its version
  std::vector<Section> sections;
};

}  // namespace dhcal

#endif  // DHCAL_CORE_REPORT_DOCUMENT_H_
