#include "store/csv.hpp"

#include <fmt/format.h>

#include <cmath>

#include "store/files.hpp"

namespace ricochet {
namespace {

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + "\"";
}

std::string heading(const Field& field) {
  return quoted(field.unit.empty() ? field.name : fmt::format("{} [{}]", field.name, field.unit));
}

// A number that is undefined leaves its cell empty.
std::string cell(double value) { return std::isnan(value) ? std::string() : fmt::format("{}", value); }

// A line of what the columns give: the numbers first.
template <class OfNumber, class OfText>
std::string line(const Table& table, OfNumber of_number, OfText of_text) {
  std::vector<std::string> cells;
  for (const NumberColumn& column : table.numbers) cells.push_back(of_number(column));
  for (const TextColumn& column : table.texts) cells.push_back(of_text(column));
  return fmt::format("{}\n", fmt::join(cells, ","));
}

}  // namespace

std::string csv(const Table& table) {
  const auto head = [](const auto& column) { return heading(column.field); };
  std::string text = line(table, head, head);
  for (std::size_t row = 0; row < table.rows(); ++row)
    text += line(
        table, [row](const NumberColumn& column) { return cell(column.values[row]); },
        [row](const TextColumn& column) { return quoted(column.values[row]); });
  return text;
}

void write_csv(const std::filesystem::path& path, const Table& table, const Provenance&) {
  write_atomically(path, csv(table));
}

}  // namespace ricochet
