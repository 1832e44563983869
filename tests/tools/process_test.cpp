// The function by which the tests start programs.
#include <csignal>

#include "tests/tools/command.h"

namespace malus::test {
namespace {

TEST(Process, ReturnsOutputAndExitCode) {
  const Finished finished = run({"sh", "-c", "echo out; echo err >&2; exit 7"});
  EXPECT_EQ(finished.exitCode, 7);
  EXPECT_EQ(finished.signal, 0);
  EXPECT_EQ(finished.out, "out\n");
  EXPECT_EQ(finished.err, "err\n");
}

TEST(Process, ReturnsSignals) {
  const Finished finished = run({"sh", "-c", "kill -SEGV $$"});
  EXPECT_EQ(finished.exitCode, -1);
  EXPECT_EQ(finished.signal, SIGSEGV);
}

TEST(Process, ReadsBothStreamsAtOnce) {
  const Finished finished = run({"sh", "-c", "head -c 300000 /dev/zero >&2; head -c 300000 /dev/zero"});
  EXPECT_EQ(finished.out.size(), 300000u);
  EXPECT_EQ(finished.err.size(), 300000u);
}

TEST(Process, KillsAfterTheTimeout) {
  const Finished finished = run({"sleep", "60"}, {.timeoutSeconds = 0.2});
  EXPECT_EQ(finished.signal, SIGKILL);
  EXPECT_LT(finished.seconds, 30);
}

TEST(Process, EnvironmentAndFolder) {
  const Finished finished =
      run({"sh", "-c", "echo $MALUS_TEST; pwd"}, {.environment = {{"MALUS_TEST", "value"}}, .workingFolder = "/"});
  EXPECT_EQ(finished.out, "value\n/\n");
}

TEST(Process, MissingProgramThrows) { EXPECT_THROW(run({"/nowhere/program"}), std::runtime_error); }

}  // namespace
}  // namespace malus::test
