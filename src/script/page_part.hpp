#pragma once

namespace ricochet {

/// A style or a script of a page, and the SHA-256 of a new line and it, in hexadecimal digits: what stands in its
/// element.
struct PagePart {
  const char *text, *sha256;
};

}  // namespace ricochet
