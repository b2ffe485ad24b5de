#include "site/technique_facts.h"

#include "embedded_families.h"
#include "techniques/catalog.h"
#include "techniques/contract/entry.h"

#include <algorithm>
#include <string_view>

namespace shadowbench::site {
namespace {

/// The folder under techniques/ that holds the technique's own; the build lists all as "family/id", semicolons between.
std::string familyOf(const std::string& technique) {
    std::string_view list = embedded::families().front().text;
    while (!list.empty()) {
        const std::string_view entry = list.substr(0, list.find(';'));
        list.remove_prefix(std::min(entry.size() + 1, list.size()));
        const std::size_t slash = entry.find('/');
        if (slash != std::string_view::npos && entry.substr(slash + 1) == technique)
            return std::string(entry.substr(0, slash));
    }
    return technique == "none" ? "baseline" : technique.starts_with("external:") ? "external" : "other";
}

std::string nameOf(techniques::Answer answer) {
    switch (answer) {
    case techniques::Answer::Hard:
        return "hard";
    case techniques::Answer::Filtered:
        return "filtered";
    case techniques::Answer::Soft:
        return "soft";
    case techniques::Answer::Colour:
        return "colour";
    }
    return "other";
}

} // namespace

TechniqueFacts factsOf(const std::string& technique) {
    const auto all = techniques::catalog();
    const auto entry = std::ranges::find(all, technique, &techniques::Entry::id);
    if (entry == all.end()) return {technique, familyOf(technique), "other", ""};
    return {entry->title, familyOf(technique), nameOf(entry->answer), namesOf(lacking(*entry))};
}

} // namespace shadowbench::site
