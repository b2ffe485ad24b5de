// The files of a chart.
#pragma once

#include "site/site_writer.h"

#include <string>

namespace shadowbench::site {

/// A drawing in another format, without a date: the same drawing gives the same bytes. Throws Inconclusive when rsvg-convert
/// is missing or fails.
std::string pdfOf(const std::string& svg);
std::string pngOf(const std::string& svg, double pixelsPerUnit);

/// Writes <name>.svg into the site and, made from it, <name>.pdf. Throws Inconclusive when rsvg-convert is missing or fails.
void writeChart(const SiteWriter& site, const std::string& name, const std::string& svg);

/// Writes <name>.pdf beside the <name>.svg that the site has.
void writePdf(const SiteWriter& site, const std::string& name);

} // namespace shadowbench::site
