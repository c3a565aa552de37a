// A report as data: what is said, in which order, and what each number is. How it looks is the
// matter of a renderer, such as core/report/text_renderer.h; none needs to know a Result.
#ifndef DHCAL_CORE_REPORT_DOCUMENT_H_
#define DHCAL_CORE_REPORT_DOCUMENT_H_

#include <cstddef>
#include <optional>
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

/// Numbers to be drawn in one pair of axes.
struct Plot {
  struct Axis {
    std::string title;
    std::string unit;                     // of the numbers: "m"; empty = none
    bool logarithmic = false;             // all numbers on it are above zero
    std::vector<std::string> names = {};  // stand at 0, 1, 2 ... instead of numbers
  };
  enum class Mark {
    kLine,    // with a mark at each point
    kCurve,   // without
    kPoints,  //
    kSteps,   // y holds from one x to the next, filled down to zero; the last y is zero
    kArrows,  // from (x, y) by (dx, dy)
    kCells,   // unit squares around (x, y)
    kBars,    // from zero to y, of unit width around x
  };
  enum class Tone {
    kOwn,     // the next of a row of colours
    kBefore,  // of what is corrected
    kAfter,
    kMuted,  // what cannot be relied on, or is not the point
  };
  /// Points in order, all finite.
  struct Series {
    std::string name;  // in the key; may be empty
    std::vector<double> x = {}, y = {};
    std::vector<double> sigma = {};  // of y, one standard deviation each; empty = not known.
                                     // Drawn as 95 % intervals
    Mark mark = Mark::kLine;
    Tone tone = Tone::kOwn;
    std::vector<double> dx = {}, dy = {};  // kArrows
    int shade = kShades;                   // kCells: from 1, faint, to kShades, strong
    bool on_right = false;                 // kCurve: y is on the axis at the right
  };
  /// A line across at one y.
  struct Level {
    std::string name;
    double y = 0;
  };
  static constexpr int kShades = 4;

  std::string title;  // of one among several; may be empty
  Axis x, y;
  std::optional<Axis> y_right;
  std::vector<Series> series;
  std::vector<Level> levels;
  bool lying = false;       // x runs downward and y to the right: for names along x
  bool same_scale = false;  // a millimetre of x is as long as one of y
};

/// Plots side by side under one caption, which says what to see. What a reader must know of them
/// stands in the text, too, for renderers that cannot draw.
struct Figure {
  std::string caption;
  std::vector<Plot> plots;

  /// True when there is nothing to show.
  bool empty() const { return plots.empty(); }
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
  std::string program;          // that made it, with its version
  std::vector<Section> answer;  // the sections in short, for forms that open with a page of that
  std::vector<Section> sections;
};

}  // namespace dhcal

#endif  // DHCAL_CORE_REPORT_DOCUMENT_H_
