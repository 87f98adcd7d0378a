#pragma once
#include <filesystem>
#include <string>

namespace ricochet {

/// The commit that a program was built from. Changed ("-dirty") or unknown sources are like no others: the hash of the
/// program itself stands for them. Throws FileError.
std::string commit_of(const std::string& commit, const std::filesystem::path& program);

/// That of this program.
const std::string& own_commit();

}  // namespace ricochet
