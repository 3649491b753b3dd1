#pragma once

namespace seacrane {

/// How linear theory, which ends at z = 0, is taken to the moving surface.
enum class Stretching {
  /// J. D. Wheeler (1970): taken at z' = (z - eta) / (1 + eta / depth), so that the profile of still water
  /// spans from the sea floor to the surface. The pressure vanishes at the surface exactly; below it the
  /// field no longer satisfies Laplace's equation exactly.
  wheeler,
  /// Linear theory itself up to z = 0, above it the values of z = 0.
  none
};

}  // namespace seacrane
