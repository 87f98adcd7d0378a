#pragma once
// Mistakes of a script, an argument or a file. Numerical endings of an impact are values (Status), never errors.

#include <filesystem>
#include <stdexcept>
#include <string>

namespace ricochet {

/// The program's exit statuses.
enum class Exit { ok = 0, script = 1, usage = 2, numerical = 3, file = 4, interrupted = 130 };

/// One clear sentence that names the place and the remedy; the program prints it after "error: " and exits with `exit`.
struct Error : std::runtime_error {
  explicit Error(const std::string& message, Exit status = Exit::script) : std::runtime_error(message), exit(status) {}
  Exit exit;
};

/// A mistake in one field of a table, so that the script layer can point at the field's own line.
struct FieldError : Error {
  FieldError(std::string field_name, const std::string& message) : Error(message), field(std::move(field_name)) {}
  std::string field;
};

/// A field mistake that only showed when a scene of a list was built or started.
struct SceneError : FieldError {
  SceneError(const FieldError& error, std::size_t scene_index) : FieldError(error), scene(scene_index) {}
  std::size_t scene;
};

struct FileError : Error {
  explicit FileError(const std::string& message) : Error(message, Exit::file) {}
};

/// Any exception as an error with its exit status; one of the file system names its file.
inline Error as_error(const std::exception& error) {
  if (const auto* known = dynamic_cast<const Error*>(&error)) return *known;
  if (const auto* file = dynamic_cast<const std::filesystem::filesystem_error*>(&error))
    return FileError("cannot use " + file->path1().string() + ": " + file->code().message() +
                     "; see that it and its folder can be read and written");
  return Error(error.what());
}

}  // namespace ricochet
