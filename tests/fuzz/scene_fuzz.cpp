// Owns the fuzz target for scene files: any bytes are read or refused as scene_claims.h says, without an error in
// memory.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "tests/fuzz/scene_claims.h"
#include "tests/fuzz/scene_damage.h"

using namespace beltlife;

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto verdict = scene_claims::judge({reinterpret_cast<const char*>(data), size});
  for (const std::string& words : verdict.broken) std::fprintf(stderr, "broken claim: %s\n", words.c_str());
  if (!verdict.broken.empty()) std::abort();
  return 0;
}

// Bytes alone seldom leave a scene that gets as far as its layout: two times in three a line is damaged instead.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned seed) {
  scene_damage::Random random(seed);
  if (size == 0 || scene_damage::below(3, random) == 0) return LLVMFuzzerMutate(data, size, max_size);
  std::string text(reinterpret_cast<const char*>(data), size);
  scene_damage::damage_line(text, random);
  if (text.empty() || text.size() > max_size) return LLVMFuzzerMutate(data, size, max_size);
  std::memcpy(data, text.data(), text.size());
  return text.size();
}
