// Interface of a fuzzing target. It reads the bytes of a file and accepts malus::Error. Another exception, a crash, a
// hang or a huge allocation is a finding.
#pragma once

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
