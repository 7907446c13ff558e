#include <pthread.h>

#include <memory>
#include <span>

#include "condyle/radial.hpp"
#include "simd/instruction_set.hpp"
#include "support/test.hpp"

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define CONDYLE_HAS_GUARDS
#endif
#endif

namespace condyle::radial {
namespace {

/// Far more than a query takes, whatever becomes of it.
constexpr std::size_t stack_size = std::size_t{1} << 20;
constexpr unsigned char untouched = 0xa5;

void* call(void* what) {
  (*static_cast<const std::function<void()>*>(what))();
  return nullptr;
}

/// Bytes of the stack of a thread of its own that are written by the time this is done, the thread's own included.
std::size_t stack_touched_by(const std::function<void()>& what) {
  constexpr std::size_t page = 4096;
  const std::unique_ptr<void, void (*)(void*)> memory(std::aligned_alloc(page, stack_size), std::free);
  const std::span<unsigned char> stack(static_cast<unsigned char*>(memory.get()), stack_size);
  std::fill(stack.begin(), stack.end(), untouched);
  pthread_attr_t attributes;
  pthread_t thread;
  EXPECT_EQ(pthread_attr_init(&attributes), 0);
  EXPECT_EQ(pthread_attr_setstack(&attributes, stack.data(), stack.size()), 0);
  const int error = pthread_create(&thread, &attributes, call, const_cast<std::function<void()>*>(&what));
  EXPECT_EQ(error, 0);
  if (error == 0) {
    EXPECT_EQ(pthread_join(thread, nullptr), 0);
  }
  EXPECT_EQ(pthread_attr_destroy(&attributes), 0);
  // It grows downwards.
  const auto lowest =
      std::find_if(stack.begin(), stack.end(), [](unsigned char b) { return b != untouched; });
  return static_cast<std::size_t>(stack.end() - lowest);
}

/// The bound that radial/query/penetrations.hpp states, for code as it is built for use: where compilers do not
/// optimise, or put guards between variables, frames are larger.
TEST(QueryStack, APenetrationQueryStaysBelow16kBOfStack) {
#if !defined(__OPTIMIZE__) || defined(CONDYLE_HAS_GUARDS)
  GTEST_SKIP() << "frames are larger in a build that is not optimised or has sanitizers";
#endif
  const RadialTable table(test::socket(Vec3::Zero(), 25, 30, 4));
  // Points of the surface itself too, which exact arithmetic decides.
  const TriMesh mobile = test::joined(test::sphere(Vec3::Zero(), 24.8, 4), table.mesh());
  const SortedPoints points(mobile.vertices);
  Pose X_FM = Pose::Identity();
  PenetrationWork work;
  for (const double shift : {0.0, 0.5, 3.0}) {
    X_FM.translation() = shift * Vec3(1, 2, 2) / 3;
    for (const simd::InstructionSet& set : simd::instruction_sets()) {
      const simd::InstructionSetInUse in_use(set);
      Penetrations found;
      const std::function<void()> query = [&] { table.penetrations(points, X_FM, found, &work); };
      // The first call resolves symbols once, which is no work of the query.
      query();
      EXPECT_GT(found.size(), 100u);
      const std::size_t own = stack_touched_by([] {}), with_query = stack_touched_by(query);
      EXPECT_GT(with_query, own + 1024) << set.name;
      EXPECT_LE(with_query, own + 16 * 1024) << set.name << " shifted by " << shift;
    }
  }
  EXPECT_GT(work.uncertain, 0u);
}

}  // namespace
}  // namespace condyle::radial
