#pragma once

namespace seacrane {

struct Model;

/// Checks that loads can start as they are described, and gives those states that jump their first value.
void start_loads(Model& model);

}  // namespace seacrane
