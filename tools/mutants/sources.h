// Which source files a mutant's result hangs on: what else changes leaves a kept result valid.
#pragma once

#include "tools/mutants/mutant.h"

#include <string>
#include <string_view>
#include <vector>

namespace shadowbench::mutants {

/// Those of `files` (sorted paths from the root) that the mutant's result can depend on, by the arrows of cmake/layers.txt,
/// whose text is `layers`. Of records: what renders and scores the mutant's own techniques; other families of techniques,
/// and what compares, judges or publishes records, are left out. Of a test: the folder it tests with what that includes, and
/// the test itself.
std::vector<std::string> sourcesThatMatter(const Mutant& mutant, const std::vector<std::string>& files,
                                           std::string_view layers);

} // namespace shadowbench::mutants
