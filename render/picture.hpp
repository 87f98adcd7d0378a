#pragma once
// Frames to paintings: where everything goes, and the layers that were asked for. Knows nothing of the engine.

#include <string>
#include <vector>

#include "render/survey.hpp"

namespace ricochet::render {

/// One impact that is shown: its mesh, and what was seen of the whole sequence.
struct Subject {
  FrameMesh mesh;
  Fields fields{mesh};
  Survey survey{};
  std::string title{};

  explicit Subject(FrameMesh of) : mesh(std::move(of)) {}
  Subject(const Subject&) = delete;
  Subject& operator=(const Subject&) = delete;
  void see(const Show& show, const Frame& frame) { survey.see(show, mesh, fields, frame); }
};

/// A subject at a moment, in its place in the grid.
struct Tile {
  const Subject* subject;
  const Frame* frame;
  std::size_t index;    ///< of the frame in the surveyed sequence
  std::string caption;  ///< above it
};

struct Layout {
  int width, height;  ///< of the painting [pixels]
  int columns = 1;
};

/// Paints tiles row by row. `clock` stands in the upper left corner.
Painting paint(const Show& show, const Layout& layout, Font& font, const std::vector<Tile>& tiles,
               const std::string& clock);

/// "t = 1.25 R/c", and Psi1 if all tiles have the same.
std::string clock_text(const std::vector<Tile>& tiles);
/// A number with four digits at most, and a true minus.
std::string number_text(double value, double step = 0);

/// A rectangle of the painting. [pixels]
struct Box {
  double x = 0, y = 0, width = 0, height = 0;
};

// Parts that are drawn beside the bodies (overlays.cpp).
/// A value that is marked beside a colour bar.
struct BarMark {
  double value;
  std::string text;
};
/// `factor`: what 1 beside the bar is in the scale.
std::vector<BarMark> bar_marks(const Scale& scale, double factor, bool tall);
void draw_colour_bar(Canvas& canvas, const Box& box, int size, const Scale& scale, const std::vector<Colour>& colours,
                     const std::vector<BarMark>& marks);
/// Of a ledger of this width, its legend in as many rows as it needs. [pixels]
double ledger_height(Canvas& canvas, double width, int size, const Subject& subject);
void draw_ledger(Canvas& canvas, const Box& box, int size, const Tile& tile);
void draw_plot(Canvas& canvas, const Box& box, int size, const Tile& tile, const Quantity& quantity);
/// The power of ten that an axis up to `most` is best given in; 0 for numbers of common size.
int power_of(double most);
/// That of times up to `last` [R/c]; 0 in the paper's units.
int time_power(const Units& units, double last);
/// "m0 c^2/R" with its index set low.
std::string typeset(std::string unit);
/// A unit behind its power of ten.
std::string unit_text(const std::string& unit, int power);
/// That of a quantity in these bodies: what is per area in the plane is per volume in bodies of revolution.
std::string unit_of(const Quantity& quantity, const FrameMesh& mesh);
/// "name [unit]", with the power of ten, in the user's units.
std::string label_of(const Quantity& quantity, int power, const FrameMesh& mesh);

}  // namespace ricochet::render
