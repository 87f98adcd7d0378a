#include "script/own_commit.hpp"

#include "core/hash.hpp"
#include "script/version.hpp"
#include "store/files.hpp"

namespace ricochet {

std::string commit_of(const std::string& commit, const std::filesystem::path& program) {
  if (!commit.ends_with("-dirty") && commit != "unknown") return commit;
  return commit + ", program " + hash_text(read_file(program));
}

const std::string& own_commit() {
  static const std::string commit = commit_of(version_commit, "/proc/self/exe");
  return commit;
}

}  // namespace ricochet
