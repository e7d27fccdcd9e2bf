// Owns the guard that stepping allocates nothing: every global operator new of this executable is counted.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "sim/energy.h"
#include "sim/run.h"
#include "sim/scene/scene_io.h"

namespace {

std::atomic<long> allocations{0};

void* counted(std::size_t size, std::size_t alignment = alignof(std::max_align_t)) {
  ++allocations;
  // aligned_alloc wants a multiple of the alignment.
  void* p = std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
  if (!p) throw std::bad_alloc();
  return p;
}

}  // namespace

// The array and nothrow versions end in these.
void* operator new(std::size_t size) { return counted(size ? size : 1); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return counted(size ? size : 1, static_cast<std::size_t>(alignment));
}
void operator delete(void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }

namespace beltlife {
namespace {

TEST(AllocationCounter, SeesPlainArrayAndAlignedAllocations) {
  const long before = allocations;
  // Calls by name, which the optimiser may not leave out as it may new-expressions.
  ::operator delete(::operator new(4));
  ::operator delete[](::operator new[](24));
  const NodeArray nodes(16);
  EXPECT_GE(allocations - before, 3);
}

class Stepping : public testing::TestWithParam<std::pair<const char*, Scheme>> {};

TEST_P(Stepping, AllocatesNothingOnceTheContactsHaveGrown) {
  const auto [name, scheme] = GetParam();
  const Model model = compile(read_scene(std::string(BELTLIFE_SCENES "/") + name + ".toml").scene);
  SpeedProfile profile;
  if (model.driver.body >= 0) profile = SpeedProfile({0, 0.01}, {0, 60}, harmonics_of(*model.scene.driver));
  Simulator s(model, profile, scheme, stable_step(model, scheme));
  while (s.time() < 0.005) s.advance();
  const std::int64_t search = s.state().refresh_step;
  const long before = allocations;
  while (s.time() < 0.02) s.advance();
  EXPECT_EQ(allocations - before, 0);
  EXPECT_EQ(s.state().refresh_step > search, model.pulleys > 0);  // contacts were searched for meanwhile
}

TEST_P(Stepping, IsAccountedForWithoutAllocating) {
  const auto [name, scheme] = GetParam();
  const Model model = compile(read_scene(std::string(BELTLIFE_SCENES "/") + name + ".toml").scene);
  const SpeedProfile rest;
  Simulator s(model, rest, scheme, stable_step(model, scheme));
  s.advance();
  const long before = allocations;
  (void)powers(s.view());
  (void)stored_energy(s.view());
  EXPECT_EQ(allocations - before, 0);
}

INSTANTIATE_TEST_SUITE_P(
    EveryKindOfDrive, Stepping,
    testing::Values(std::pair{"baseline", Scheme::thesis}, std::pair{"baseline", Scheme::symplectic_euler},
                    std::pair{"accessory_drive", Scheme::symplectic_euler}, std::pair{"two_pulley", Scheme::thesis},
                    std::pair{"spinning_ring", Scheme::thesis}, std::pair{"overrunning_alternator", Scheme::thesis},
                    std::pair{"overrunning_alternator", Scheme::symplectic_euler}),
    [](const auto& info) { return std::string(info.param.first) + "_" + std::string(enum_name(info.param.second)); });

// Allocations of a whole run may depend on its windows and channels, never on its number of steps.
TEST(Run, AllocatesAsOftenHoweverManyStepsItTakes) {
  const auto allocations_of = [](const char* step) {
    const SceneSpec scene =
        read_scene(BELTLIFE_SCENES "/baseline.toml",
                   {"belt.elements=128", std::string("solver.step_s=") + step, "profile.settle_s=0.01",
                    "profile.ramp_s=0.02", "profile.hold_s=0.02", "profile.evaluate_s=0.01"})
            .scene;
    const Model model = compile(scene);
    const RunPlan plan = plan_range(scene, scene.range[0]);
    const long before = allocations;
    const RunRecord record = run(model, plan).record;
    const long during = allocations - before;
    EXPECT_TRUE(record.status.ok()) << record.status.cause;
    return std::pair{during, record.steps};
  };
  const auto [coarse, few] = allocations_of("1e-6");
  const auto [fine, many] = allocations_of("5e-7");
  EXPECT_EQ(many, 2 * few);
  EXPECT_NEAR(fine, coarse, 4);  // the segments of contact may grow once more or less
}

}  // namespace
}  // namespace beltlife
