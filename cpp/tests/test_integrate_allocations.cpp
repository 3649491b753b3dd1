#include <doctest/doctest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "count_allocations.hpp"
#include "test_integrate_problems.hpp"

namespace {
std::atomic<long> allocations{0};
}

// Not inlined: the compiler would warn of free() for what it takes as the standard operator new.
// The array forms call these by default; the nothrow form does not under AddressSanitizer.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* const memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++allocations;
  return std::malloc(size > 0 ? size : 1);
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace seacrane::test {

long allocation_count() { return allocations.load(); }

TEST_CASE("the allocation counter counts") {
  const long before = allocation_count();
  const auto pointer = std::make_unique<std::vector<double>>(100);
  CHECK(allocation_count() == before + 2);
}

TEST_CASE("the own methods allocate nothing once they are initialised") {
  for (const IntegratorProperties& method : methods(is_own)) {
    const std::string name = method.name;
    CAPTURE(name);
    Pendulum system(true);
    PendulumResidual residual;
    const auto integrator = make_integrator(problem(system, &residual), with_tolerance(name, 1e-6));
    const double start[4] = {1.0, 0.0, 0.0, 0.0};
    integrator->init(0.0, start);
    const EventFunction lowest = [](double, const double* y) { return y[0]; };
    double y[4];
    long events = 0;
    const long before = allocation_count();
    while (integrator->time() < 10.0) {
      integrator->step(10.0);
      integrator->interpolate(0.5 * (integrator->previous_time() + integrator->time()), y);
      if (integrator->locate(lowest)) ++events;
      if (events == 3) integrator->reset(integrator->time(), integrator->state());
    }
    CHECK(allocation_count() == before);
    // The last one is at the very end, where a method of order 1 is late.
    CHECK(events >= (name == "semi-implicit-euler" ? 9 : 10));
  }
}

}  // namespace seacrane::test
