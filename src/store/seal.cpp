#include "store/seal.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "core/hash.hpp"
#include "core/hash_pieces.hpp"
#include "store/files.hpp"
#include "store/hdf5.hpp"

namespace ricochet::hdf5 {
namespace {

constexpr std::string_view content_words = "size and hash of content, and the hash of both: ";

std::string line_of(const Content& content) {
  const std::string text = fmt::format("{} {}", content.size, content.hash);
  return fmt::format("{}{} {}\n", content_words, text, hash_text(text));
}

}  // namespace

Content content_of(const std::string& bytes) {
  const std::size_t begin = bytes.find('\n') + 1;
  if (bytes.compare(begin, content_words.size(), content_words) != 0) return {};
  Content content;
  std::istringstream(bytes.substr(begin + content_words.size(), seal_size)) >> content.size >> content.hash;
  const std::string line = line_of(content);
  return bytes.compare(begin, line.size(), line) == 0 ? content : Content{};
}

Sealed sealed_in(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw FileError(fmt::format("cannot read {}: {}", path.string(), std::strerror(errno)));
  std::string piece(1 << 20, '\0');
  const auto next = [&](std::size_t most) {
    file.read(piece.data(), static_cast<std::streamsize>(most));
    return std::string_view(piece).substr(0, static_cast<std::size_t>(file.gcount()));
  };
  Sealed found;
  found.seal = next(seal_size);
  found.size = found.seal.size();
  Hasher hasher;
  for (std::string_view bytes = next(piece.size()); !bytes.empty(); bytes = next(piece.size())) {
    hasher.add(bytes);
    found.size += bytes.size();
  }
  found.hash = hasher.text();
  return found;
}

std::string seal_with(const std::string& hash, const Content& content) {
  std::string seal = std::string(seal_words) + hash + "\n";
  if (!content.hash.empty()) seal += line_of(content);
  seal.resize(seal_size, '\n');
  return seal;
}

std::string seal_of(std::string_view bytes, const std::string& content) {
  return seal_with(hash_text(bytes), {seal_size + bytes.size(), content});
}

void seal(const std::filesystem::path& path, const std::string& content) {
  const Sealed found = sealed_in(path);
  const std::string text = seal_with(found.hash, {found.size, content});
  std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
  if (!file.write(text.data(), static_cast<std::streamsize>(text.size())).flush())
    throw FileError(fmt::format("cannot write {}: {}", path.string(), std::strerror(errno)));
}

}  // namespace ricochet::hdf5
