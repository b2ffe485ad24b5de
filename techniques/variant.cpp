#include "techniques/catalog.h"

#include "base/error.h"
#include "base/words.h"
#include "techniques/folder/description.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fnmatch.h>

namespace shadowbench::techniques {
namespace {

std::vector<std::string> ids() {
    std::vector<std::string> result;
    for (const Entry& entry : catalog()) result.push_back(entry.id);
    return result;
}

Variant make(const Entry& entry, std::string_view assignments) {
    Parameters parameters = parseParameters(assignments, entry.parameters, entry.id);
    if (const auto why = entry.contradiction ? entry.contradiction(parameters) : std::nullopt)
        throw BadInput(fmt::format("{}: {}", entry.id, *why));
    std::string name = canonicalVariant(entry.id, parameters, entry.parameters);
    return {&entry, std::move(parameters), std::move(name)};
}

} // namespace

const Entry& entryNamed(std::string_view id) {
    for (const Entry& entry : catalog())
        if (entry.id == id) return entry;
    throw BadInput(fmt::format("there is no technique \"{}\"{}; the techniques are: {}", id, didYouMean(id, ids()),
                               fmt::join(ids(), ", ")));
}

Variant parseVariant(std::string_view text) {
    const std::size_t colon = text.find(':', text.starts_with(folderPrefix) ? folderPrefix.size() : 0);
    const Entry& entry = entryNamed(text.substr(0, colon));
    return make(entry, colon == std::string_view::npos ? "" : text.substr(colon + 1));
}

std::vector<Variant> matchVariants(const std::string& pattern) {
    if (pattern.find_first_of("*?[") == std::string::npos) return {parseVariant(pattern)};
    std::vector<Variant> result;
    for (const Entry& entry : catalog()) {
        if (fnmatch(pattern.c_str(), entry.id.c_str(), 0) != 0) continue;
        for (const std::string& assignments : entry.variants) result.push_back(make(entry, assignments));
    }
    if (result.empty())
        throw BadInput(fmt::format("no technique matches \"{}\"; the techniques are: {}", pattern, fmt::join(ids(), ", ")));
    return result;
}

std::optional<Variant> costBase(const Variant& variant) {
    if (!variant.entry->costBase) return std::nullopt;
    return parseVariant(variant.entry->costBase(variant.parameters));
}

} // namespace shadowbench::techniques
