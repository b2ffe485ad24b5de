#include "report/families.h"

#include "embedded_families.h"
#include "harness/records/record.h"

#include <algorithm>
#include <string_view>

namespace shadowbench::report {
namespace {

// Told apart by every kind of colour vision, on white and, in the page's other set, on black.
constexpr Family all[] = {
    {"planar", "planar shadows", "#75924D"},
    {"maps", "shadow maps", "#CD7919"},
    {"filtered", "filtered maps", "#523ACB"},
    {"soft", "soft, from a map", "#1D9C77"},
    {"volumes", "shadow volumes", "#631483"},
    {"sampled", "light samples", "#755400"},
    {"modern", "what engines ship", "#12001B"},
    {"environment", "environment light", "#154219"},
    {"lod", "levels of detail", "#C960E0"},
    {"external", "other renderers", "#525252"},
    {"other", "others", "#9E73A4"},
};

/// The folder under techniques/ that holds the technique's own; the build lists all as "family/id", semicolons between.
std::string_view folderOf(std::string_view technique) {
    std::string_view list = embedded::families().front().text;
    while (!list.empty()) {
        const std::string_view entry = list.substr(0, list.find(';'));
        list.remove_prefix(std::min(entry.size() + 1, list.size()));
        const std::size_t slash = entry.find('/');
        if (slash != std::string_view::npos && entry.substr(slash + 1) == technique) return entry.substr(0, slash);
    }
    return technique.starts_with(externalPrefix) ? "external" : "other";
}

} // namespace

std::span<const Family> families() { return all; }

const Family& familyOf(const std::string& technique) {
    const auto found = std::ranges::find(all, folderOf(technique), &Family::id);
    return found == std::end(all) ? *(std::end(all) - 1) : *found;
}

} // namespace shadowbench::report
