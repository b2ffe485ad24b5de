// Whose moving frames the pages of cells hold.
#pragma once

namespace shadowbench::site {

/// The cells of the Pareto fronts (where nothing was timed, the ten of a scene with least error), or all.
enum class Sequences { Fronts, All };

} // namespace shadowbench::site
