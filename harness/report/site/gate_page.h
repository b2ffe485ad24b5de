// The page of a gate's verdict.
#pragma once

#include "harness/gate/gate.h"
#include "harness/report/site/site_writer.h"

#include <vector>

namespace shadowbench::site {

/// gate.html: what is worse first, then what could not be judged or told, then what is better, with the command that shows
/// each again and the pictures of failing cells beside those of the base.
void addGatePage(const gate::GateResult& result, const gate::GateOptions& options, SiteWriter& site);

/// The comparison of records with older ones, as a gate's result.
gate::GateResult comparedWith(const std::vector<Record>& base, const std::vector<Record>& head);

} // namespace shadowbench::site
