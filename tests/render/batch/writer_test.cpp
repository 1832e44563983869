#include "render/batch/writer.h"

#include <atomic>
#include <stdexcept>

#include <gtest/gtest.h>

namespace malus::render {
namespace {

TEST(WriterThread, CallsTasksInOrder) {
  std::vector<int> order;
  WriterThread writer;
  for (int i = 0; i < 100; ++i) writer.push([&order, i] { order.push_back(i); });
  writer.finish();
  ASSERT_EQ(order.size(), 100u);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(order[static_cast<std::size_t>(i)], i);
}

// The caller runs ahead by the tasks that may wait and the one that is running.
TEST(WriterThread, QueueIsBounded) {
  std::atomic<int> done{0};
  int most = 0;
  WriterThread writer;
  for (int i = 0; i < 50; ++i) {
    writer.push([&done] {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      ++done;
    });
    most = std::max(most, i + 1 - done);
  }
  writer.finish();
  EXPECT_EQ(done, 50);
  EXPECT_LE(most, static_cast<int>(WriterThread::kMostWaiting) + 1);
}

TEST(WriterThread, FailuresReachTheCaller) {
  std::atomic<int> after{0};
  WriterThread writer;
  writer.push([] { throw std::runtime_error("disk full"); });
  EXPECT_THROW(
      for (int i = 0; i < 100; ++i) {
        writer.push([&after] { ++after; });
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      },
      std::runtime_error);
  EXPECT_THROW(writer.finish(), std::runtime_error);
  EXPECT_LT(after, 100);
}

TEST(WriterThread, CanEndWithWaitingTasks) {
  std::atomic<int> done{0};
  {
    WriterThread writer;
    for (int i = 0; i < 3; ++i) writer.push([&done] { ++done; });
  }
  EXPECT_LE(done, 3);
}

}  // namespace
}  // namespace malus::render
