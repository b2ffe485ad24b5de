// Point sets that techniques sample with: pure functions, the same on every machine.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

namespace shadowbench::techniques {

/// Element `index` ≥ 0 of the van der Corput sequence in `base` ≥ 2: a number in [0, 1). Halton points take coprime bases.
double halton(std::uint32_t index, std::uint32_t base);

/// A frame's Halton number in `base`; index 0 (the origin) is left out. A seed other than 1 turns the sequence by an angle
/// of its own in each base (Cranley and Patterson 1976). Another start in the sequence would not do: it gives the points of
/// another seed, some frames later, wherever two starts differ by little modulo powers of the bases.
double haltonOf(int frame, std::uint32_t seed, std::uint32_t base);

enum class Region { Disk, Square }; // the unit disk, or [−1, 1]²

/// `count` points of the region, well apart from each other and from its rim (best-candidate Poisson disk), deterministic;
/// the first is the centre.
std::vector<glm::vec2> poissonTaps(int count, Region region);

/// side × side cell centres of the square [−1, 1]².
std::vector<glm::vec2> gridTaps(int side);

/// The same as `poissonTaps`, which take longer to find than a small map to draw: kept by the thread.
const std::vector<glm::vec2>& keptPoissonTaps(int count, Region region);

/// Offset in steps and weight of the pairs of taps beside the middle one of a Gaussian whose deviation is `sigma` steps; the
/// middle one's weight is what is left of 1.
std::vector<glm::vec2> gaussianPairs(int count, double sigma);

} // namespace shadowbench::techniques
