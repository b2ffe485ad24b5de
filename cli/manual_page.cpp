#include "cli/documents.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <string_view>

namespace shadowbench {
namespace {

/// Text with roff's own characters escaped, and no line that begins with one of its requests.
std::string roff(std::string_view text) {
    std::string escaped;
    for (const char c : text) {
        const bool startsLine = escaped.empty() || escaped.back() == '\n';
        if (startsLine && (c == '.' || c == '\'')) escaped += "\\&";
        if (c == '\\')
            escaped += "\\e";
        else if (c == '-')
            escaped += "\\-";
        else
            escaped += c;
    }
    return escaped;
}

/// Lines as they are: examples, tables.
std::string verbatim(const std::string& text) { return text.empty() ? "" : fmt::format(".PP\n.nf\n{}\n.fi\n", roff(text)); }

std::string optionEntry(const CLI::Option& option) {
    std::string head = fmt::format("\\fB{}\\fR", roff(option.get_name(option.get_positional(), true)));
    if (!option.get_type_name().empty()) head += fmt::format(" {}", roff(option.get_type_name()));
    if (!option.get_default_str().empty()) head += fmt::format(" (default: {})", roff(option.get_default_str()));
    return fmt::format(".TP\n{}\n{}\n", head, roff(option.get_description()));
}

std::string verbSection(const CLI::App& verb, const std::string& path) {
    const std::string name = path.empty() ? verb.get_name() : path + " " + verb.get_name();
    std::string text = fmt::format(".SS {}\n{}\n", roff(name), roff(verb.get_description()));
    for (const CLI::Option* option : verb.get_options())
        if (!option->get_group().empty()) text += optionEntry(*option);
    text += verbatim(verb.get_footer());
    for (const CLI::App* inner : verb.get_subcommands({}))
        if (!inner->get_group().empty()) text += verbSection(*inner, name);
    return text;
}

} // namespace

std::string manualPage(const CLI::App& app, const std::string& version) {
    std::string text = fmt::format(".TH SHADOWBENCH 1 \"\" \"shadowbench {}\" \"User Commands\"\n", roff(version));
    const std::string description = app.get_description(); // "shadowbench scores …"
    text += fmt::format(".SH NAME\nshadowbench \\- {}\n", roff(description.substr(description.find(' ') + 1)));
    text += ".SH SYNOPSIS\n.B shadowbench\n\\fIVERB\\fR [\\fIOPTIONS\\fR]\n.SH OPTIONS\n";
    for (const CLI::Option* option : app.get_options()) text += optionEntry(*option);
    text += ".SH VERBS\n";
    for (const CLI::App* verb : app.get_subcommands({}))
        if (!verb->get_group().empty()) text += verbSection(*verb, "");
    return text + ".SH EXIT STATUS\n" + verbatim(app.get_footer());
}

} // namespace shadowbench
