#include "core/uninitialised.hpp"
#include "support/test.hpp"

namespace condyle {
namespace {

TEST(LargeMemory, IsAlignedToACacheLineAndFromTwoMegabytesOnToALargePage) {
  for (const std::size_t bytes : {std::size_t{1}, std::size_t{65536}, std::size_t{70001},
                                  (std::size_t{2} << 20) - 1, std::size_t{2} << 20, std::size_t{70} << 20}) {
    auto* const memory = static_cast<unsigned char*>(core::allocate_large(bytes));
    const std::size_t alignment = bytes >= std::size_t{2} << 20 ? std::size_t{2} << 20 : 64;
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(memory) % alignment, 0u) << bytes;
    memory[0] = 1, memory[bytes - 1] = 2;
    core::free_large(memory, bytes);
  }
}

TEST(UninitialisedVector, KeepsWhatWasWrittenAsItGrows) {
  core::UninitialisedVector<std::size_t> values;
  for (std::size_t count : {std::size_t{10}, std::size_t{400000}}) {
    const std::size_t before = values.size();
    values.resize(count);
    for (std::size_t i = before; i < count; ++i) values[i] = 3 * i;
  }
  for (std::size_t i = 0; i < values.size(); ++i) ASSERT_EQ(values[i], 3 * i);
}

}  // namespace
}  // namespace condyle
