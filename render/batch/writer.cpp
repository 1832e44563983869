#include "render/batch/writer.h"

#include <utility>

#include "meshprep/base/atomic_file.h"
#include "meshprep/json_text.h"
#include "render/ground_truth/truth_image.h"
#include "render/image/output.h"
#include "render/image/polarization.h"
#include "render/sensor/expose.h"
#include "render/sensor/raw_output.h"

namespace malus::render {
namespace fs = std::filesystem;

namespace {

// Calls add(name) for each file of the sensor that is written.
template <class Add>
void writeSensor(const fs::path& folder, const Frame& frame, const RenderedFrame& rendered,
                 image::ExrCompression compression, Add add) {
  if (!frame.sensor) return;
  const Sensor& sensor = *frame.sensor;
  const RawImage raw = expose(rendered.image, sensor, frame.exposure);
  const auto write = [&](FrameOutput output, const auto& writer) {
    if (!frame.outputs.has(output)) return;
    const std::string name = frame.name + kFrameOutputs[static_cast<std::size_t>(output)].suffix;
    writer(folder / name);
    add(name);
  };
  write(FrameOutput::raw, [&](const fs::path& path) {
    const fs::path description = rawDescriptionFile(path);
    writeFile(description, jsonText(describeRaw(raw, sensor, frame.exposure, {{"frame", frame.name}})) + "\n");
    add(description.filename().string());
    writeRaw(path, raw, sensor);
  });
  write(FrameOutput::mask, [&](const fs::path& path) { writeSaturation(path, raw); });
  write(FrameOutput::sensorStokes, [&](const fs::path& path) {
    writeSensorStokes(path, raw, sensor, frame.exposureEv, rendered.image, compression);
  });
}

}  // namespace

ManifestEntry writeFrame(const fs::path& folder, const Frame& frame, RenderedFrame rendered,
                         image::ExrCompression compression, const std::string& hash) {
  ManifestEntry entry{frame.index, 0, frame.name, hash, frame.seed, rendered.method, frame.settings, {}};
  const auto write = [&](FrameOutput output, const auto& writer) {
    if (!frame.outputs.has(output)) return;
    const std::string name = frame.name + kFrameOutputs[static_cast<std::size_t>(output)].suffix;
    writer(folder / name);
    entry.files.push_back(describeFile(folder, name));
  };
  const image::Image& image = rendered.image;
  write(FrameOutput::exr, [&](const fs::path& path) { image::writeExr(path, image, compression); });
  write(FrameOutput::png, [&](const fs::path& path) { writeImage(path, image, frame.exposureEv); });
  write(FrameOutput::dolp, [&](const fs::path& path) { writeDolp(path, image, compression); });
  write(FrameOutput::aolp, [&](const fs::path& path) { writeAolp(path, image, compression); });
  write(FrameOutput::truth, [&](const fs::path& path) { writeTruth(path, rendered.truth, compression); });
  write(FrameOutput::camera, [&](const fs::path& path) {
    nlohmann::json document = {{"frame", frame.name}, {"camera", rendered.camera}, {"settings", frame.settings}};
    writeFile(path, jsonText(document) + "\n");
  });
  writeSensor(folder, frame, rendered, compression,
              [&](const std::string& name) { entry.files.push_back(describeFile(folder, name)); });
  return entry;
}

WriterThread::WriterThread() : thread_([this] { run(); }) {}

WriterThread::~WriterThread() {
  {
    const std::scoped_lock lock(mutex_);
    isStopped_ = true;
    tasks_.clear();
  }
  changed_.notify_all();
  thread_.join();
}

void WriterThread::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [&] { return isStopped_ || !tasks_.empty(); });
    if (tasks_.empty()) return;
    std::function<void()> task = std::move(tasks_.front());
    tasks_.pop_front();
    isRunning_ = true;
    lock.unlock();
    changed_.notify_all();
    std::exception_ptr failure;
    try {
      task();
    } catch (...) {
      failure = std::current_exception();
    }
    task = nullptr;  // frees its image before the lock
    lock.lock();
    isRunning_ = false;
    if (failure && !failure_) {
      failure_ = failure;
      tasks_.clear();
    }
    changed_.notify_all();
  }
}

void WriterThread::push(std::function<void()> task) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return failure_ || tasks_.size() < kMostWaiting; });
  if (failure_) std::rethrow_exception(failure_);
  tasks_.push_back(std::move(task));
  changed_.notify_all();
}

void WriterThread::finish() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return tasks_.empty() && !isRunning_; });
  if (failure_) std::rethrow_exception(failure_);
}

}  // namespace malus::render
