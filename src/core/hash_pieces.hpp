#pragma once
// Hashes as hash_text() gives them, of what is too long or too many for texts.

#include <compare>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace ricochet {

/// The hash of a text that comes in pieces.
class Hasher {
 public:
  Hasher();
  ~Hasher();
  Hasher(const Hasher&) = delete;
  Hasher& operator=(const Hasher&) = delete;

  void add(std::string_view piece);
  /// Of all pieces so far, as hash_text() gives it.
  std::string text() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// A hash as a number.
struct HashKey {
  std::uint64_t high = 0, low = 0;

  /// Of 32 hexadecimal digits; other texts have a key of their own.
  static HashKey of(std::string_view digits);
  std::string digits() const;
  auto operator<=>(const HashKey&) const = default;

  struct Spread {
    std::size_t operator()(const HashKey& key) const { return static_cast<std::size_t>(key.low); }
  };
};

}  // namespace ricochet
