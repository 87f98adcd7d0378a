#pragma once
#include <exception>
#include <filesystem>
#include <functional>
#include <optional>
#include <thread>
#include <vector>

#include "core/bounded_queue.hpp"
#include "render/film.hpp"
#include "render/png.hpp"

namespace ricochet::render {

/// Takes pictures off the hands of the thread that draws them: some threads encode PNG files, one feeds a film, in
/// order.
class Studio {
 public:
  using Write = std::function<void(const std::filesystem::path&, const std::string&)>;

  /// `write(path, bytes)` is called by `encoders` threads at a time. The film, if any, is fed every picture.
  Studio(int encoders, Write write, Film* film);
  ~Studio();
  Studio(const Studio&) = delete;
  Studio& operator=(const Studio&) = delete;

  /// A picture for a file, unless `path` is empty, and for the film. Throws the first error of the threads.
  void take(Image image, const std::filesystem::path& path, Texts texts);
  /// Waits until all is written. Throws the first error.
  void finish();

 private:
  struct Job {
    std::shared_ptr<const Image> image;
    std::filesystem::path path;
    Texts texts;
  };
  template <class Work>
  std::jthread worker(BoundedQueue<Job>& queue, Work work);
  void start(int encoders);
  void close();

  Write write_;
  Film* film_;
  BoundedQueue<Job> files_, frames_{4};
  std::mutex mutex_;
  std::exception_ptr error_;
  std::vector<std::jthread> threads_;
};

}  // namespace ricochet::render
