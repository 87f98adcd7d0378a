#include "script/digest.hpp"

#include <cstring>
#include <limits>
#include <map>
#include <string_view>

#include "core/hash.hpp"

namespace ricochet {

namespace {

std::string bits_of(const std::vector<double>& values) {
  std::string bits(values.size() * sizeof(double), '\0');
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double value = values[i] == values[i] ? values[i] : std::numeric_limits<double>::quiet_NaN();
    std::memcpy(bits.data() + i * sizeof value, &value, sizeof value);
  }
  return bits;
}

std::string bits_of(const std::vector<std::string>& values) {
  std::string bits;
  for (const std::string& value : values) (bits += value) += '\0';
  return bits;
}

}  // namespace

std::string digest_of(const Table& table) {
  std::map<std::string, std::string> columns;  // a file lists them in another order than a run
  for (const NumberColumn& column : table.numbers)
    if (column.field.name != "wall_seconds") columns[column.field.name] = hash_text(bits_of(column.values));
  for (const TextColumn& column : table.texts) columns[column.field.name] = hash_text(bits_of(column.values));
  std::string text;
  for (const auto& [name, hash] : columns) text += name + '\0' + hash;
  return hash_text(text);
}

}  // namespace ricochet
