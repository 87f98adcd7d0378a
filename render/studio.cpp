#include "render/studio.hpp"

namespace ricochet::render {

template <class Work>
std::jthread Studio::worker(BoundedQueue<Job>& queue, Work work) {
  return std::jthread([this, &queue, work] {
    try {
      while (const auto job = queue.pop()) work(*job);
    } catch (...) {
      {
        const std::lock_guard lock(mutex_);
        if (!error_) error_ = std::current_exception();
      }
      close();
    }
  });
}

Studio::Studio(int encoders, Write write, Film* film)
    : write_(std::move(write)), film_(film), files_(static_cast<std::size_t>(encoders) + 1) {
  try {
    start(encoders);
  } catch (...) {
    close();  // those that have started would wait for ever
    throw;
  }
}

void Studio::start(int encoders) {
  for (int i = 0; i < encoders; ++i)
    threads_.push_back(worker(files_, [this](const Job& job) { write_(job.path, png(*job.image, job.texts)); }));
  if (film_) threads_.push_back(worker(frames_, [this](const Job& job) { film_->add(*job.image); }));
}

Studio::~Studio() { close(); }

void Studio::close() {
  files_.close();
  frames_.close();
}

void Studio::take(Image image, const std::filesystem::path& path, Texts texts) {
  const auto shared = std::make_shared<const Image>(std::move(image));
  const bool taken =
      (!film_ || frames_.push({shared, {}, {}})) && (path.empty() || files_.push({shared, path, std::move(texts)}));
  if (!taken) finish();
}

void Studio::finish() {
  close();
  threads_.clear();  // joins
  if (error_) std::rethrow_exception(error_);
}

}  // namespace ricochet::render
