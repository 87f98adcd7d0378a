#pragma once
#include <map>
#include <string>
#include <vector>

#include "store/table.hpp"

namespace ricochet {

/// The digest of outcomes: 32 hexadecimal digits of the names and bits of all columns but `wall_seconds`, the only one
/// that the machine has a part in, in the order of the rows. Equal digests are what "the same bits" means, wherever the
/// impacts ran; files differ by times and host besides. NaN is one value.
std::string digest_of(const Table& table);

/// The same of columns that come one by one.
class Digest {
 public:
  void add(const std::string& name, const std::vector<double>& values);
  void add(const std::string& name, const std::vector<std::string>& values);
  std::string text() const;

 private:
  std::map<std::string, std::string> columns_;  // a file lists them in another order than a run
};

}  // namespace ricochet
