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

void Digest::add(const std::string& name, const std::vector<double>& values) {
  if (name != "wall_seconds") columns_[name] = hash_text(bits_of(values));
}

void Digest::add(const std::string& name, const std::vector<std::string>& values) {
  columns_[name] = hash_text(bits_of(values));
}

std::string Digest::text() const {
  std::string text;
  for (const auto& [name, hash] : columns_) text += name + '\0' + hash;
  return hash_text(text);
}

std::string digest_of(const Table& table) {
  Digest digest;
  for (const NumberColumn& column : table.numbers) digest.add(column.field.name, column.values);
  for (const TextColumn& column : table.texts) digest.add(column.field.name, column.values);
  return digest.text();
}

}  // namespace ricochet
