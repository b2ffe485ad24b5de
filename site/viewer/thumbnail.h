// Small pictures of cells for the first page.
#pragma once

#include "harness/records/record.h"
#include "site/site_writer.h"

#include <filesystem>
#include <string>

namespace shadowbench::site {

/// Writes what a record's technique shows, cut to a square, into the site; its address from the site's folder, "" where
/// `images` holds no picture of it.
std::string thumbnail(const Record& record, const std::filesystem::path& images, const SiteWriter& site);

/// Writes assets/card.png, which hosts of links show: truth, technique and error of the record's cell side by side.
/// `hasCell` of it holds.
void writeCard(const Record& record, const std::filesystem::path& images, const SiteWriter& site);

} // namespace shadowbench::site
