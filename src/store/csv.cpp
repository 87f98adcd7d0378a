#include "store/csv.hpp"

#include <fmt/format.h>

#include <algorithm>
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

namespace {

std::string head_of(const Table& table) {
  const auto head = [](const auto& column) { return heading(column.field); };
  return line(table, head, head);
}

std::string lines_of(const Table& table) {
  std::string text;
  for (std::size_t row = 0; row < table.rows(); ++row)
    text += line(
        table, [row](const NumberColumn& column) { return cell(column.values[row]); },
        [row](const TextColumn& column) { return quoted(column.values[row]); });
  return text;
}

template <class Column>
void put_in_order(std::vector<Column>& columns, const std::vector<std::string>& names) {
  const auto place = [&](const Column& c) { return std::find(names.begin(), names.end(), c.field.name); };
  std::sort(columns.begin(), columns.end(), [&](const Column& a, const Column& b) { return place(a) < place(b); });
}

}  // namespace

std::string csv(const Table& table) { return head_of(table) + lines_of(table); }

void write_long_csv(const std::filesystem::path& path, const StoredTable& table,
                    const std::vector<std::string>& names) {
  constexpr std::size_t block = 4096;  // rows
  AtomicFile file(path);
  for (std::size_t first = 0; first < table.rows(); first += block) {
    Table part = table.part(first, std::min(block, table.rows() - first), [](const Field&) { return true; });
    put_in_order(part.numbers, names);
    put_in_order(part.texts, names);
    if (first == 0) file.add(head_of(part));
    file.add(lines_of(part));
  }
  file.finish();
}

void write_csv(const std::filesystem::path& path, const Table& table, const Provenance&) {
  write_atomically(path, csv(table));
}

}  // namespace ricochet
