#pragma once
// The file of the methods and steps that trials chose, for runs to come.

#include <filesystem>
#include <string>

#include "impact/chosen_steps.hpp"

namespace ricochet {

/// What trials of earlier runs and of this one chose. The file is text: a line a choice, under a heading with the
/// program's version and commit, whose choices alone are taken, and a hash of the rest. One of more than 20,000 choices
/// counts as empty.
class RememberedSteps {
 public:
  /// All of it; the file is read the first time. One of another version counts as empty, and so does a damaged one, of
  /// which `warning` then tells. Throws FileError for a file that is something else, which would be overwritten.
  TriedChoices& read(const std::filesystem::path& file);
  /// Adds to the file what is new. Throws FileError.
  /// True if something is among them that was not in the file.
  bool has_new() const { return tried_.size() != from_file_; }
  void write(const std::filesystem::path& file) const;

  std::string warning;  ///< what was wrong with the file

 private:
  TriedChoices tried_;
  bool was_read_ = false;
  std::size_t from_file_ = 0;
};

}  // namespace ricochet
