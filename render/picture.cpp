#include "render/picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "render/tile.hpp"

namespace ricochet::render {
namespace {

const ColourMap& map_of(const Show& show, const Quantity& quantity) {
  return colour_map_named(show.colours != "auto" ? show.colours.c_str() : quantity.is_signed ? "puor" : "ylgnbu");
}

}  // namespace

std::string clock_text(const std::vector<Tile>& tiles) {
  // As many decimals as tell one frame from the next.
  const std::vector<double>& times = tiles[0].subject->survey.times;
  double least = 0.1;
  for (std::size_t k = 1; k < times.size(); ++k) least = std::min(least, times[k] - times[k - 1]);
  const Units& units = tiles[0].subject->mesh.units;
  const int power = time_power(units, times.back());
  const double factor = std::pow(10.0, power) / units.worth("R/c");
  std::string text = fmt::format("t = {} {}",
                                 number_text(tiles[0].frame->time / factor,
                                             std::pow(10.0, std::floor(std::log10(std::max(least / factor, 1e-9))))),
                                 unit_text(units.name("R/c"), power));
  const double psi1 = tiles[0].subject->mesh.psi1;
  for (const Tile& tile : tiles)
    if (tile.subject->mesh.psi1 != psi1) return text;
  const double degrees = std::atan(psi1) * 180 / std::numbers::pi;
  return std::isnan(psi1) ? text
                          : text + fmt::format("    Ψ_1 = {} = tan {}°", number_text(psi1), number_text(degrees));
}

namespace {

// How a picture is divided: rows and columns of cells, and the size of the texts beside them.
struct Sheet {
  const Show& show;
  const Layout& layout;
  int columns, rows, text;
  double stroke, line, pad;
};

Sheet sheet_of(const Show& show, const Layout& layout, std::size_t tiles) {
  const int columns = layout.columns, rows = (static_cast<int>(tiles) + columns - 1) / columns;
  const double shortest = std::min<double>(layout.height, layout.width / 1.5);
  const int text = std::max(layout.height < 300 ? 9 : 11,
                            static_cast<int>(std::lround(shortest / 36.0 * (rows > 1 || columns > 2 ? 0.85 : 1.0))));
  return {show,
          layout,
          columns,
          rows,
          text,
          std::max(1.0, shortest / 720.0),
          std::round(1.5 * text),
          std::round(0.6 * text)};
}

// The bar of colours beside the cells, if there is one: `quantity` is what it shows.
struct ColourBar {
  const Quantity* quantity = nullptr;
  std::string label;
  std::vector<BarMark> marks;
  double width = 0;  // with its marks
};

ColourBar colour_bar_of(const Sheet& sheet, const Brush& brush, Canvas& over, const Quantity* quantity,
                        const FrameMesh& mesh) {
  if (!quantity || !sheet.show.colour_bar) return {nullptr, "", {}, sheet.pad};
  const double worth = mesh.units.worth(unit_of(*quantity, mesh));
  const int power = power_of(worth * std::max(std::abs(brush.scale.low), std::abs(brush.scale.high)));
  ColourBar bar{quantity, label_of(*quantity, power, mesh), {}, sheet.pad};
  bar.marks = bar_marks(brush.scale, std::pow(10.0, power) / worth, sheet.layout.height > 15 * sheet.text);
  for (const BarMark& mark : bar.marks)
    bar.width = std::max(bar.width, std::round(over.text_width(mark.text, sheet.text) + 2.6 * sheet.text));
  return bar;
}

// The lines above the cells: the title, then the clock and what the bar shows. Returns where they end.
double draw_head(Canvas& over, const Sheet& sheet, const ColourBar& bar, const std::string& clock) {
  const auto& [show, layout, columns, rows, text, stroke, line, pad] = sheet;
  double top = pad;
  if (!show.title.empty()) {
    over.text_within(layout.width - 2 * pad, {layout.width / 2.0, top + 1.05 * text}, show.title,
                     static_cast<int>(std::lround(1.15 * text)), black, Align::centre);
    top += 1.2 * line;
  }
  if (clock.empty() && !bar.quantity) return top;
  // The clock takes what it needs, up to half of the line if the bar's label stands there too.
  const double width = layout.width - 2 * pad;
  if (bar.quantity && !clock.empty() && over.text_width(clock, text) + over.text_width(bar.label, text) + pad > width) {
    over.text_within(width, {pad, top + text}, clock, text, black);
    over.text_within(width, {layout.width - pad, top + line + text}, bar.label, text, black, Align::right);
    return top + 2 * line;
  }
  const double half = bar.quantity ? (layout.width - 3 * pad) / 2.0 : width;
  const double taken = clock.empty() ? 0 : std::min(half, over.text_width(clock, text));
  if (!clock.empty()) over.text_within(half, {pad, top + text}, clock, text, black);
  if (bar.quantity)
    over.text_within(layout.width - 3 * pad - taken, {layout.width - pad, top + text}, bar.label, text, black,
                     Align::right);
  return top + line;
}

// The heights that a cell gives to what stands over and under its scene.
struct Strips {
  double caption, ledger, plot;
  double left_of(double height) const { return height - caption - ledger - plot; }
};

Box cell_of(const Sheet& sheet, const Box& all, std::size_t k) {
  const int column = static_cast<int>(k) % sheet.columns, row = static_cast<int>(k) / sheet.columns;
  return {std::round(all.x + all.width * column / sheet.columns), std::round(all.y + all.height * row / sheet.rows),
          std::floor(all.width / sheet.columns), std::floor(all.height / sheet.rows)};
}

void check_room(const Sheet& sheet, const Box& cell, const Strips& strips, bool alone) {
  if (alone && strips.ledger + strips.plot <= 0) return;
  if (strips.left_of(cell.height) >= 2.5 * sheet.text && cell.width >= 8 * sheet.text) return;
  throw FieldError(
      "size", fmt::format("there is no room for {} {} and {} of {:.0f} x {:.0f} pixels each beside their texts, "
                          "ledger and plot; make the picture larger or show less",
                          sheet.columns, sheet.columns == 1 ? "column" : "columns",
                          sheet.rows == 1 ? "a row" : fmt::format("{} rows", sheet.rows), cell.width, cell.height));
}

// A title that is too long is cut; the moment behind it ("title, t = 1.5 R/c") stays.
void draw_caption(Canvas& over, double room, const Vec2& at, const std::string& caption, int text) {
  const std::size_t moment = caption.rfind(", t = ");
  const double taken = moment == std::string::npos ? 0 : over.text_width(caption.substr(moment), text);
  if (taken == 0 || taken > 0.75 * room || over.text_width(caption, text) <= room) {
    over.text_within(room, at, caption, text, black, Align::centre);
    return;
  }
  over.text_cut(room - taken, {at.x() - room / 2, at.y()}, caption.substr(0, moment), text, black);
  over.text({at.x() + room / 2, at.y()}, caption.substr(moment), text, black, Align::right);
}

// The texts, the ledger and the plot of a cell.
void draw_strips(Canvas& over, const Sheet& sheet, const Box& cell, const Strips& strips, const Tile& tile) {
  const int text = sheet.text;
  const double left = cell.x + 2 * sheet.pad, width = cell.width - 4 * sheet.pad;
  if (strips.caption > 0)
    draw_caption(over, cell.width - sheet.pad, {cell.x + cell.width / 2, cell.y + text}, tile.caption, text);
  if (sheet.show.ledger)
    draw_ledger(over, {left, cell.y + cell.height - strips.plot - strips.ledger, width, strips.ledger}, text, tile);
  if (const Quantity* plotted = plotted_quantity(sheet.show))
    draw_plot(over, {left, cell.y + cell.height - strips.plot, width, strips.plot - 0.3 * text}, text, tile, *plotted);
}

}  // namespace

Painting paint(const Show& show, const Layout& layout, Font& font, const std::vector<Tile>& tiles,
               const std::string& clock) {
  const Sheet sheet = sheet_of(show, layout, tiles.size());
  const int text = sheet.text;
  std::vector<const Survey*> surveys;
  for (const Tile& tile : tiles) surveys.push_back(&tile.subject->survey);
  const Quantity* quantity = coloured_quantity(show);
  const FrameMesh& mesh = tiles[0].subject->mesh;
  const double worth = quantity ? mesh.units.worth(unit_of(*quantity, mesh)) : 1;
  const Brush brush{show, common_scale(show, surveys, worth), text, sheet.stroke};

  Painting painting;
  painting.material_coloured = quantity && show.material == quantity->name;
  painting.springs_coloured = quantity && !painting.material_coloured;
  if (quantity)
    for (int i = 0; i < 256; ++i) painting.colours.push_back(colour_of(map_of(show, *quantity), i / 255.0));

  Canvas over(font);
  const ColourBar bar = colour_bar_of(sheet, brush, over, quantity, tiles[0].subject->mesh);
  const double top = draw_head(over, sheet, bar, clock);
  if (bar.quantity)
    draw_colour_bar(over,
                    {layout.width - bar.width + std::round(0.6 * text), top + sheet.pad + std::round(0.9 * text),
                     std::round(0.9 * text), layout.height - top - 3.0 * sheet.pad - std::round(1.8 * text)},
                    text, brush.scale, painting.colours, bar.marks);

  const Box all{0, top, layout.width - bar.width, layout.height - top};
  const bool captions = std::any_of(tiles.begin(), tiles.end(), [](const Tile& tile) { return !tile.caption.empty(); });
  double ledger = 0;
  for (const Tile& tile : tiles)
    if (show.ledger)
      ledger = std::max(ledger, ledger_height(over, all.width / sheet.columns - 4 * sheet.pad, text, *tile.subject));
  const Strips strips{captions ? sheet.line : 0, ledger,
                      plotted_quantity(show) ? std::max(7.5 * text, 0.26 * all.height / sheet.rows) : 0};
  for (std::size_t k = 0; k < tiles.size(); ++k) {
    const Tile& tile = tiles[k];
    const Box cell = cell_of(sheet, all, k);
    check_room(sheet, cell, strips, tiles.size() == 1);
    const Box scene{cell.x, cell.y + strips.caption, cell.width, std::max(1.0, strips.left_of(cell.height))};
    const View view = view_of(show, tile, tiles, scene, show.anchors ? text : sheet.pad);
    // Where scenes share a scale each tells once how far it goes.
    const auto same = [&](const Tile& other) { return other.subject == tile.subject; };
    Brush own = brush;
    own.compares = std::find_if(tiles.begin(), tiles.end(), same) - tiles.begin() == static_cast<std::ptrdiff_t>(k) &&
                   !std::all_of(tiles.begin(), tiles.end(), same);
    // Bodies under a camera that sees a part are cut at the border of their cell; others fit anyway.
    painting.panels.push_back(draw_tile(own, font, tile, view, scene, painting.colours));
    draw_strips(over, sheet, cell, strips, tile);
  }
  painting.over = over.take();
  return painting;
}

}  // namespace ricochet::render
