// ricochet.plot, histogram and heat_map (in lua/ricochet, each in a file of its name), and gnuplot, which draws them.

#include <fmt/format.h>
#include <sys/wait.h>

#include <filesystem>

#include "render/font.hpp"
#include "script/gnuplot.hpp"
#include "script/reader.hpp"
#include "script/run_files.hpp"
#include "store/files.hpp"
#include "store/run_names.hpp"

namespace ricochet {

namespace fs = std::filesystem;

namespace {

// A script whose texts gnuplot can draw: of a character that no font has, Pango draws a sign that covers the picture.
std::string drawable(Session& session, const std::string& script) {
  render::Font font(render::usual_font);
  std::string text = font.drawable(script);
  if (!font.missing().empty())
    session.warn(
        fmt::format("the font of plots lacks {} and draws boxes; for Chinese, Japanese and Korean: apt-get "
                    "install fonts-noto-cjk",
                    font.missing()));
  return text;
}

// gnuplot(name, text): writes NAME.gp into the run's folder and lets gnuplot draw NAME.svg and NAME.png.
int gnuplot(lua_State* L) {
  Session& session = session_of(L);
  const fs::path script = below_folder(L, luaL_checkstring(L, 1) + std::string(run_names::plot_script));
  const auto beside = [&](const char* extension) { return fs::path(script).replace_extension(extension); };
  session.folders.claim(session.own_folder());
  for (const char* kind : {run_names::plot_script, run_names::picture, run_names::vector_picture})
    session.folders.own(beside(kind));
  write_atomically(script, drawable(session, luaL_checkstring(L, 2)));
  for (const char* kind : {run_names::picture, run_names::vector_picture})  // gnuplot would write through a link
    if (fs::is_symlink(beside(kind))) fs::remove(beside(kind));
  const int status = run_gnuplot(script.parent_path(), "./" + script.filename().string(), !session.options.unsafe);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw FileError(fmt::format("gnuplot could not draw {} (its message stands above)", script.string()));
  const fs::path picture = beside(run_names::picture);
  if (!fs::exists(picture))
    throw FileError(fmt::format("gnuplot has not drawn {}; is the gnuplot in PATH the real one?", picture.string()));
  session.inform(fmt::format("plot: {}\n", picture.string()));
  return 0;
}

// What every plot has beside what it draws.
std::vector<Field> fields_of_the_file(std::string added) {
  return {{"name", "string", "", "file name without extension"},
          {"title", "string", "", "above the plot", any_number, "", true},
          {"caption", "string", "", "below the plot: parameters; " + std::move(added) + ", is added", any_number, "",
           true}};
}

Function histogram_function() {
  std::vector<Field> fields{
      {"rows", "rows", "", "rows of a sweep; those that finished count"},
      {"of", "string", "", "column whose values are counted", any_number, "e"},
      {"by", "string or strings", "", "column, or columns, for each of whose values there is a panel", any_number, "",
       true},
      {"bins",
       "integer",
       "",
       "how many, from the least value to the greatest; unless given they are 2 IQR/n^(1/3) wide, IQR the range of "
       "the middle half of n values [Freedman & Diaconis 1981], in all panels the median of theirs, and those of e "
       "meet at 1",
       {1, 200},
       "",
       true}};
  for (Field& field : fields_of_the_file("how many impacts finished and failed, and how wide bins are"))
    fields.push_back(std::move(field));
  return {.name = "histogram",
          .doc =
              "Counts the values of a column, one panel for each value of `by`, with the mean and its standard error, "
              "and where e = 1 is; as NAME.svg and NAME.png, and leaves the gnuplot script NAME.gp beside them.",
          .fields = std::move(fields),
          .returns = "nothing",
          .example = "ricochet.histogram { rows = rows, by = \"psi1\", name = \"spread\" }"};
}

Function heat_map_function() {
  std::vector<Field> fields{
      {"rows", "rows", "", "rows of a sweep over at least the two columns"},
      {"x", "string", "", "column along x"},
      {"y", "string", "", "column along y"},
      {"of", "string", "", "column whose mean colours the cells", any_number, "e"},
      {"xnames", "strings", "", "instead of the values along x, in their rising order", any_number, "", true},
      {"ynames", "strings", "", "the same along y", any_number, "", true},
      {"log", "string", "", "axes with a logarithmic scale", any_number, "none", false, {"none", "x", "y", "xy"}}};
  for (Field& field :
       fields_of_the_file("how many impacts finished and failed, over what is averaged, and the greatest "
                          "standard error"))
    fields.push_back(std::move(field));
  return {.name = "heat_map",
          .doc =
              "Draws the mean of a column over two others as coloured cells that meet halfway between the values, "
              "with numbers where all fit; cells without a finished row are hatched. As NAME.svg and NAME.png, "
              "and leaves the gnuplot script NAME.gp beside them.",
          .fields = std::move(fields),
          .returns = "nothing",
          .example = "ricochet.heat_map { rows = rows, x = \"speed\", y = \"psi1\", of = \"e\", name = \"map\" }"};
}

}  // namespace

Group plot_functions() {
  return {
      .functions =
          {{.name = "plot",
            .doc = "Draws the mean and standard error of columns against a column, lines of theory and published "
                   "points, as NAME.svg and NAME.png, and leaves the gnuplot script NAME.gp beside them.",
            .fields =
                {{"rows", "rows", "",
                  "rows of a sweep, or of a series, drawn as a line in their order; none for a picture of theory alone",
                  any_number, "", true},
                 {"x", "string", "", "column along x; rows are grouped by it"},
                 {"y", "strings", "", "columns along y, one panel each"},
                 {"by", "string or strings", "", "column whose values are drawn as a line each, or several", any_number,
                  "", true},
                 {"samples", "boolean", "", "whether every impact is drawn beside the means", any_number, "false"},
                 {"log",
                  "string",
                  "",
                  "axes with a logarithmic scale",
                  any_number,
                  "none",
                  false,
                  {"none", "x", "y", "xy"}},
                 {"theory", "table", "",
                  "column = function (x), points { {x, y}, ... }, or a list of { name =, f = } and { name =, points = "
                  "}: drawn dashed beside that column",
                  any_number, "{}"},
                 {"theory_name", "string", "", "in the key, of a line that has no name of its own", any_number,
                  "theory"},
                 {"published", "table", "",
                  "column = points { {x, y}, ... } or a list of { name =, points = }: drawn as open marks", any_number,
                  "{}"},
                 {"name", "string", "", "file name without extension"},
                 {"title", "string", "", "above the plot", any_number, "", true},
                 {"caption", "string", "",
                  "below the plot: parameters; how many impacts finished and failed, and over what is averaged, is "
                  "added",
                  any_number, "", true},
                 {"xlabel", "string", "", "instead of the column's words and unit", any_number, "", true},
                 {"ylabel", "table", "", "column = text instead of its name and unit", any_number, "{}"},
                 {"xrange", "numbers", "", "{ from, to } along x; all rows and points unless given", any_number, "",
                  true},
                 {"yrange", "table", "", "column = { from, to }", any_number, "{}"}},
            .returns = "nothing",
            .example = "ricochet.plot { rows = rows, x = \"psi1\", y = { \"e\", \"mu\" }, name = \"angles\" }"},
           histogram_function(),
           heat_map_function()},
      .natives = {{"gnuplot", guarded<gnuplot>}}};
}

}  // namespace ricochet
