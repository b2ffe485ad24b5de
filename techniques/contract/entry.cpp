#include "techniques/contract/entry.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace shadowbench::techniques {

namespace {

std::string_view title(Document document) {
    switch (document) {
    case Document::Dissertation:
        return "Scherzer, dissertation";
    case Document::PixelCorrectPaper:
        return "Scherzer et al., EGSR 2007";
    case Document::Course:
        return "SIGGRAPH 2004 course, Real-Time Shadowing Techniques";
    case Document::Zapotocky:
        return "Zápotocký, thesis";
    case Document::Other:
        break;
    }
    return "";
}

} // namespace

std::string citation(const Source& source) {
    return source.document == Document::Other ? source.where : fmt::format("{}, {}", title(source.document), source.where);
}

std::set<Need> lacking(const Entry& entry) {
    std::set<Need> needs = entry.lacks;
    if (entry.temporal) needs.insert(Need::NoHistory);
    return needs;
}

std::map<std::string, double> declaredFigures(const Entry& entry, std::map<std::string, double> figures) {
    for (const auto& [name, value] : figures) {
        const bool declared = std::ranges::find(entry.figures, name, &Figure::name) != entry.figures.end();
        if (!declared)
            throw InternalError(fmt::format("technique {} reports a figure \"{}\" that its catalogue entry does not declare",
                                            entry.id, name));
        if (!std::isfinite(value))
            throw InternalError(
                fmt::format("technique {}: its figure \"{}\" is {}; leave out what has no value", entry.id, name, value));
    }
    return figures;
}

} // namespace shadowbench::techniques
