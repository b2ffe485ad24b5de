// The page of a gate's verdict.
#pragma once

#include "gate/gate.h"
#include "site/site_writer.h"
#include "site/viewer/cells.h"

#include <filesystem>
#include <optional>
#include <vector>

namespace shadowbench::site {

/// A cell that is worse, as both sides draw it.
struct ComparedCell {
    RunCell head;
    std::optional<RunCell> base; // nothing where that has no images
};

/// gate.html: what is looser than the base, the ten worst with pictures of `cells`, whose pages have been written, then how
/// many changes each class has, then everything with the command that shows it again.
void addGatePage(const gate::GateResult& result, const gate::GateOptions& options, const std::vector<ComparedCell>& cells,
                 SiteWriter& site);

/// A run's records and the folder of its images, which may be missing.
struct RunImages {
    const std::vector<Record>& records;
    std::filesystem::path images;
};

/// The cells of the changes for the worse, a dozen at most: more show the same fault again.
std::vector<ComparedCell> worseCells(const std::vector<gate::Change>& changes, const RunImages& base, const RunImages& head);

} // namespace shadowbench::site
