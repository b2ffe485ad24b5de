#include "harness/foreign/expected_failures.h"

#include "base/files.h"
#include "base/toml_value.h"

#include <algorithm>
#include <fnmatch.h>

namespace shadowbench::foreign {
namespace {

/// Text that says something.
std::string sentenceIn(const TomlValue& entry, const char* key) {
    const TomlValue value = entry.get(key);
    if (value.text().empty()) value.fail("is empty");
    return value.text();
}

} // namespace

bool ExpectedFailure::covers(const std::string& on, const std::string& row) const {
    const auto isMeant = [&](const std::string& id) { return fnmatch(id.c_str(), row.c_str(), 0) == 0; };
    return scene == on && std::ranges::any_of(renderers, isMeant);
}

std::vector<ExpectedFailure> readExpectedFailures(const std::filesystem::path& file) {
    const toml::table root = parseToml(readFile(file), file.string());
    const TomlSource source{.file = file.string()};
    const auto list = TomlValue(source, "", root).find("expect");
    std::vector<ExpectedFailure> all;
    if (!list) return all;
    for (const TomlValue& entry : list->list()) {
        entry.only({"scene", "renderers", "says", "reason"});
        ExpectedFailure failure{.scene = entry.get("scene").text(),
                                .renderers = {},
                                .says = sentenceIn(entry, "says"),
                                .reason = sentenceIn(entry, "reason"),
                                .where = entry.where()};
        for (const TomlValue& id : entry.get("renderers").list()) failure.renderers.push_back(id.text());
        all.push_back(std::move(failure));
    }
    return all;
}

} // namespace shadowbench::foreign
