#pragma once

namespace seacrane::test {

/// Calls of operator new in this process so far (replaced in test_integrate_allocations.cpp).
long allocation_count();

}  // namespace seacrane::test
