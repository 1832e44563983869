// Writes frames in a thread, so that the next frame is traced meanwhile.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <filesystem>
#include <functional>
#include <mutex>
#include <thread>

#include "meshprep/base/image.h"
#include "render/batch/frame.h"
#include "render/batch/frame_renderer.h"
#include "render/batch/manifest.h"

namespace malus::render {

// Writes the files of a frame and returns its entry. Each file is complete or absent (atomic_file.h). Throws Error.
ManifestEntry writeFrame(const std::filesystem::path& folder, const Frame& frame, RenderedFrame rendered,
                         image::ExrCompression compression, const std::string& hash);

// Calls tasks in their order, in one thread. At most kMostWaiting wait: memory stays bounded if writing is slower.
class WriterThread {
 public:
  static constexpr std::size_t kMostWaiting = 4;

  WriterThread();
  // Drops the tasks that wait; finish() does not.
  ~WriterThread();
  WriterThread(const WriterThread&) = delete;
  WriterThread& operator=(const WriterThread&) = delete;

  // Waits while kMostWaiting tasks wait. Throws what an earlier task threw; no further tasks are called then.
  void push(std::function<void()> task);
  // Waits for all tasks. Throws what one of them threw.
  void finish();

 private:
  void run();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> tasks_;
  bool isRunning_ = false;  // a task
  bool isStopped_ = false;
  std::exception_ptr failure_;
  std::thread thread_;  // last: it uses the others
};

}  // namespace malus::render
