#include "techniques/folder/reading.h"

#include "base/one_line.h"
#include "base/words.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>

namespace shadowbench::techniques {

std::string identifier(const TomlValue& value, const std::string& name) {
    const auto allowed = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
    if (name.empty() || name.size() > 40 || std::isalpha(static_cast<unsigned char>(name.front())) == 0 ||
        !std::ranges::all_of(name, allowed) || name.starts_with("gl_") || name.find("__") != std::string::npos)
        value.fail(fmt::format("\"{}\" is no name in GLSL: a letter, then letters, digits and _, 40 at most", name));
    return name;
}

std::string words(const TomlValue& value) {
    std::string text = value.text();
    if (text.empty()) value.fail("is empty; say it in a few words");
    if (onOneLine(text) != text) value.fail("has line ends or other control characters; say it in one line");
    return text;
}

std::string macroOf(std::string name) {
    for (char& c : name) {
        const auto letter = static_cast<unsigned char>(c);
        c = std::isalnum(letter) != 0 ? static_cast<char>(std::toupper(letter)) : '_';
    }
    return name;
}

std::vector<std::string> macrosOf(const Parameter& parameter) {
    const auto* choices = std::get_if<OneOf>(&parameter.domain);
    if (choices == nullptr) return {macroOf(parameter.name)};
    std::vector<std::string> macros;
    for (const std::string& word : choices->values) macros.push_back(macroOf(parameter.name + "_" + word));
    return macros;
}

Amount amountOf(const TomlValue& value, const TechniqueFolder& read) {
    if (!value.isText()) return value.number();
    std::vector<std::string> numbers;
    for (const Parameter& parameter : read.entry.parameters)
        if (!std::holds_alternative<OneOf>(parameter.domain)) numbers.push_back(parameter.name);
    if (std::ranges::count(numbers, value.text()) == 0)
        value.fail(
            fmt::format("\"{}\" is no parameter that is a number{}", value.text(), didYouMean(value.text(), numbers)));
    return value.text();
}

} // namespace shadowbench::techniques
