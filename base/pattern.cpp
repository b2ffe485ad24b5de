#include "base/pattern.h"

#include <memory>
#include <regex.h>
#include <stdexcept>

namespace shadowbench {

std::vector<std::string> firstMatch(const std::string& text, const std::string& pattern) {
    regex_t compiled;
    if (regcomp(&compiled, pattern.c_str(), REG_EXTENDED) != 0)
        throw std::invalid_argument("no regular expression: " + pattern);
    const std::unique_ptr<regex_t, void (*)(regex_t*)> release(&compiled, regfree);
    std::vector<regmatch_t> found(compiled.re_nsub + 1);
    if (regexec(&compiled, text.c_str(), found.size(), found.data(), 0) != 0) return {};
    std::vector<std::string> groups;
    for (const regmatch_t& group : found)
        groups.push_back(group.rm_so < 0 ? "" : text.substr(group.rm_so, group.rm_eo - group.rm_so));
    return groups;
}

} // namespace shadowbench
