#include "cli/documents.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <string>
#include <vector>

namespace shadowbench {
namespace {

/// A verb with the words that may follow it: its verbs; its options and the values of its argument.
struct Verb {
    std::string words; // "reference", "cache list"
    std::vector<std::string> options, verbs;
};

std::vector<const CLI::App*> shownVerbs(const CLI::App& app) {
    return app.get_subcommands([](const CLI::App* verb) { return !verb->get_group().empty(); });
}

/// "TEXT:{a,b}" → "a b": the values that an option's type lists; "" if it lists none.
std::string listedValues(const CLI::Option& option) {
    const std::string type = option.get_type_name();
    const std::size_t open = type.find('{'), close = type.find('}');
    if (open == std::string::npos || close == std::string::npos) return "";
    std::string values = type.substr(open + 1, close - open - 1);
    for (char& c : values)
        if (c == ',') c = ' ';
    return values;
}

void collect(const CLI::App& app, const std::string& words, std::vector<Verb>& verbs) {
    Verb verb{words, {}, {}};
    for (const CLI::Option* option : app.get_options()) {
        for (const std::string& name : option->get_lnames()) verb.options.push_back("--" + name);
        if (option->get_positional() && !listedValues(*option).empty()) verb.options.push_back(listedValues(*option));
    }
    for (const CLI::App* inner : shownVerbs(app)) verb.verbs.push_back(inner->get_name());
    verbs.push_back(verb);
    for (const CLI::App* inner : shownVerbs(app))
        collect(*inner, words.empty() ? inner->get_name() : words + " " + inner->get_name(), verbs);
}

/// The case of each option of `app` whose values are listed: `run --cost) candidates="time none" ;;`.
std::string valueCases(const CLI::App& app, const std::string& words) {
    std::string cases;
    for (const CLI::Option* option : app.get_options()) {
        const std::string values = listedValues(*option);
        if (values.empty()) continue;
        for (const std::string& name : option->get_lnames())
            cases += fmt::format("        \"{} --{}\") candidates=\"{}\" ;;\n", words, name, values);
    }
    for (const CLI::App* inner : shownVerbs(app))
        cases += valueCases(*inner, words.empty() ? inner->get_name() : words + " " + inner->get_name());
    return cases;
}

constexpr const char* scriptHead = R"(# Completion of shadowbench, written by the program itself.
_shadowbench() {
    local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]} verb= candidates= word
    for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
        case "$verb $word" in
)";

constexpr const char* scriptValues = R"(        esac
    done
    case "$previous" in
        --scene) candidates=$("${COMP_WORDS[0]}" list scenes --format ids 2>/dev/null) ;;
        --technique) candidates=$("${COMP_WORDS[0]}" list techniques --format ids 2>/dev/null) ;;
    esac
    case "$verb $previous" in
)";

constexpr const char* scriptOptions = R"(    esac
    if [ -z "$candidates" ]; then
        case "$verb" in
)";

constexpr const char* scriptTail = R"(        esac
        case "$current" in
            -*) ;;
            *) [ "${previous#--}" = "$previous" ] || candidates= ;; # the value of an option: a file, a number
        esac
    fi
    COMPREPLY=($(compgen -W "$candidates" -- "$current"))
}
complete -o default -F _shadowbench shadowbench
)";

} // namespace

std::string bashCompletion(const CLI::App& app) {
    std::vector<Verb> verbs;
    collect(app, "", verbs);
    std::string text = scriptHead;
    for (const Verb& verb : verbs)
        if (!verb.words.empty()) {
            const std::size_t space = verb.words.rfind(' ');
            const std::string outer = space == std::string::npos ? "" : verb.words.substr(0, space);
            const std::string name = space == std::string::npos ? verb.words : verb.words.substr(space + 1);
            text += fmt::format("            \"{} {}\") verb=\"{}\" ;;\n", outer, name, verb.words);
        }
    text += scriptValues + valueCases(app, "") + scriptOptions;
    for (const Verb& verb : verbs)
        text += fmt::format(
            "            \"{}\") candidates=\"{}\" ;;\n", verb.words,
            fmt::join({fmt::format("{}", fmt::join(verb.verbs, " ")), fmt::format("{}", fmt::join(verb.options, " "))},
                      verb.verbs.empty() ? "" : " "));
    return text + scriptTail;
}

std::string zshCompletion(const CLI::App& app) {
    return "#compdef shadowbench\nautoload -U +X bashcompinit && bashcompinit\n" + bashCompletion(app);
}

} // namespace shadowbench
