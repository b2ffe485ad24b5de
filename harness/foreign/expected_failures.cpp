#include "harness/foreign/expected_failures.h"

#include "base/files.h"
#include "base/toml_value.h"

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
    return scene == on && fnmatch(renderer.c_str(), row.c_str(), 0) == 0;
}

std::vector<ExpectedFailure> readExpectedFailures(const std::filesystem::path& file) {
    const toml::table root = parseToml(readFile(file), file.string());
    const TomlSource source{.file = file.string()};
    const auto list = TomlValue(source, "", root).find("expect");
    std::vector<ExpectedFailure> all;
    if (!list) return all;
    for (const TomlValue& of : list->list()) {
        of.only({"scene", "fails"});
        for (const TomlValue& entry : of.get("fails").list()) {
            entry.only({"renderer", "says", "reason"});
            all.push_back({of.get("scene").text(), sentenceIn(entry, "renderer"), sentenceIn(entry, "says"),
                           sentenceIn(entry, "reason"), entry.where()});
        }
    }
    return all;
}

} // namespace shadowbench::foreign
