#include "site/technique_facts.h"

#include "report/families.h"
#include "techniques/catalog.h"
#include "techniques/contract/entry.h"

#include <algorithm>

namespace shadowbench::site {
namespace {

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
    const std::string family = report::familyOf(technique).id;
    if (entry == all.end()) return {technique, family, "other", ""};
    return {entry->title, family, nameOf(entry->answer), namesOf(lacking(*entry))};
}

} // namespace shadowbench::site
