// What a fuzzing target is: bytes of a file from anywhere. An Error is an answer; anything else that it throws, a
// crash, a hang or a huge allocation is a finding.
#pragma once

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
