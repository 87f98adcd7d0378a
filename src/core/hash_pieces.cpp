#include "core/hash_pieces.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <charconv>

namespace ricochet {
namespace {

bool is_number(std::string_view digits, std::uint64_t& value) {
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
  return error == std::errc() && end == digits.data() + digits.size();
}

}  // namespace

struct Hasher::State {
  XXH3_state_t* pieces = XXH3_createState();
  State() { XXH3_128bits_reset(pieces); }
  ~State() { XXH3_freeState(pieces); }
};

Hasher::Hasher() : state_(std::make_unique<State>()) {}
Hasher::~Hasher() = default;

void Hasher::add(std::string_view piece) { XXH3_128bits_update(state_->pieces, piece.data(), piece.size()); }

std::string Hasher::text() const {
  const XXH128_hash_t hash = XXH3_128bits_digest(state_->pieces);
  return HashKey{hash.high64, hash.low64}.digits();
}

std::string HashKey::digits() const { return fmt::format("{:016x}{:016x}", high, low); }

HashKey HashKey::of(std::string_view digits) {
  HashKey key;
  if (digits.size() == 32 && is_number(digits.substr(0, 16), key.high) && is_number(digits.substr(16), key.low))
    return key;
  const XXH128_hash_t hash = XXH3_128bits(digits.data(), digits.size());
  return {hash.high64, hash.low64};
}

}  // namespace ricochet
