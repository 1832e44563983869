// Frames and time from an event to the frame that shows it.
#include "render/viewer/input_latency.h"

#include <gtest/gtest.h>

namespace malus::viewer {
namespace {
using std::chrono::milliseconds;

InputLatency::Time at(int ms) { return InputLatency::Time{} + milliseconds(ms); }

TEST(InputLatency, OfAChangeOfTheDisplayIsTheNextFrame) {
  InputLatency latency;
  latency.submit(1);
  latency.present(at(0), 1);
  latency.receive(at(5));
  latency.receive(at(9));  // the first counts
  latency.submit(1);
  latency.present(at(20), 1);
  latency.present(at(40), 1);
  ASSERT_EQ(latency.displayOnly().size(), 1u);
  EXPECT_DOUBLE_EQ(latency.displayOnly()[0].ms, 15);
  EXPECT_EQ(latency.displayOnly()[0].frames, 1u);
  EXPECT_TRUE(latency.rendered().empty());
}

TEST(InputLatency, OfAnImageIsTheFrameOfItsGenerationOrOfALaterOne) {
  InputLatency latency;
  latency.receive(at(0));
  latency.submit(1);
  latency.present(at(10), 0);  // an older image
  latency.receive(at(12));
  latency.submit(2);
  latency.present(at(30), 1);
  ASSERT_EQ(latency.rendered().size(), 1u);
  EXPECT_EQ(latency.rendered()[0].frames, 2u);
  latency.receive(at(35));
  latency.submit(3);
  latency.present(at(60), 3);  // generation 2 was replaced
  ASSERT_EQ(latency.rendered().size(), 3u);
  EXPECT_EQ(latency.rendered()[1].frames, 2u);
  EXPECT_DOUBLE_EQ(latency.rendered()[1].ms, 48);
  EXPECT_EQ(latency.rendered()[2].frames, 1u);
  EXPECT_TRUE(latency.displayOnly().empty());
}

// Of a generation without an event, such as the next step of a free flight.
TEST(InputLatency, CountsEventsOnly) {
  InputLatency latency;
  for (std::uint64_t i = 1; i < 10; ++i) {
    latency.submit(i);
    latency.present(at(static_cast<int>(i)), i);
  }
  EXPECT_TRUE(latency.rendered().empty());
  EXPECT_TRUE(latency.displayOnly().empty());
}

TEST(InputLatency, KeepsTheNewest) {
  InputLatency latency;
  for (int i = 0; i < 3000; ++i) {
    latency.receive(at(100 * i));
    latency.present(at(100 * i + (i < 2000 ? 50 : 10)), 0);
  }
  EXPECT_LE(latency.displayOnly().size(), 1000u);
  for (const LatencySample& sample : latency.displayOnly()) EXPECT_DOUBLE_EQ(sample.ms, 10);
}

}  // namespace
}  // namespace malus::viewer
