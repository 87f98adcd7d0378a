#include "script/sweep_parameters.hpp"

#include <fmt/format.h>

#include "script/sweep_table.hpp"

namespace ricochet {

std::string Parameters::place(std::size_t scene) const {
  std::string text;
  for (std::size_t p = 0; p < names.size(); ++p)
    text += fmt::format("{}{} = {}", p ? ", " : "", names[p],
                        texts[p].empty() ? fmt::format("{:g}", numbers[p][scene]) : "'" + texts[p][scene] + "'");
  return text;
}

namespace {

// The column of parameter `p`.
void add_column(Table& table, const Parameters& given, std::size_t p, const std::vector<std::size_t>& scenes) {
  const std::string& name = given.names[p];
  // An outcome of the same name is what the impact had; the parameter is what the sweep asked for: keep both.
  const Field field{table.number(name) || table.text(name) ? "over_" + name : name, "number", given.units[p],
                    sweep_table::parameter};
  if (!given.texts[p].empty()) {
    table.texts.insert(table.texts.begin(), {field, {}});
    for (const std::size_t i : scenes) table.texts.front().values.push_back(given.texts[p][i]);
  } else {
    table.numbers.insert(table.numbers.begin(), {field, {}});
    for (const std::size_t i : scenes) table.numbers.front().values.push_back(given.numbers[p][i]);
  }
}

}  // namespace

Parameters Parameters::of(const std::vector<std::size_t>& scenes) const {
  Parameters own{names, units, {}, {}};
  for (std::size_t p = 0; p < names.size(); ++p) {
    own.numbers.emplace_back();
    own.texts.emplace_back();
    for (const std::size_t i : scenes) {
      if (i < numbers[p].size()) own.numbers.back().push_back(numbers[p][i]);
      if (i < texts[p].size()) own.texts.back().push_back(texts[p][i]);
    }
  }
  return own;
}

void Parameters::add_to(Table& table, const std::vector<std::size_t>& scenes) const {
  for (std::size_t p = names.size(); p-- > 0;) add_column(table, *this, p, scenes);
}

}  // namespace ricochet
