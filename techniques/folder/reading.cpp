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

std::string choice(const TomlValue& value) {
    const std::string word = value.text();
    const auto allowed = [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
               std::string_view("+-._").find(c) != std::string_view::npos;
    };
    if (word.empty() || word.size() > 40 || !std::ranges::all_of(word, allowed) ||
        macroOf(word).find("__") != std::string::npos)
        value.fail(fmt::format("\"{}\" is no word: letters and digits with +, -, . or _ between them, 40 at most", word));
    return word;
}

bool areNumbers(const OneOf& words) {
    return std::ranges::all_of(words.values, [](const std::string& word) {
        return word.size() < 10 && std::ranges::all_of(word, [](unsigned char c) { return std::isdigit(c) != 0; });
    });
}

FolderCondition conditionOf(const TomlValue& value, const TechniqueFolder& read) {
    const std::string text = value.text(), name = text.substr(0, text.find('='));
    std::vector<std::string> conditions;
    for (const Parameter& parameter : read.entry.parameters)
        if (const auto* words = std::get_if<OneOf>(&parameter.domain))
            for (const std::string& word : words->values) conditions.push_back(parameter.name + "=" + word);
    if (std::ranges::count(conditions, text) == 0)
        value.fail(fmt::format("\"{}\" is no word of a parameter with choices, as \"depth=midpoint\"{}", text,
                               didYouMean(text, conditions)));
    return {name, text.substr(name.size() + 1)};
}

bool holds(const std::optional<FolderCondition>& condition, const Parameters& values) {
    return !condition || values.text(condition->parameter) == condition->word;
}

bool isLeftOut(const TechniqueFolder& folder, const FolderTarget& target, const Parameters& values) {
    const auto writes = [&](const FolderPass& pass) { return std::ranges::count(pass.to, target.name) > 0; };
    const auto isDrawn = [&](const FolderPass& pass) { return writes(pass) && holds(pass.when, values); };
    return std::ranges::any_of(folder.passes, writes) && std::ranges::none_of(folder.passes, isDrawn);
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
    if (areNumbers(*choices)) macros.push_back(macroOf(parameter.name));
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

double valueOf(const Amount& amount, const Parameters& values) {
    if (const double* number = std::get_if<double>(&amount)) return *number;
    return values.real(std::get<std::string>(amount));
}

Amount amountWithin(const TomlValue& value, const Domain& bounds, const TechniqueFolder& read) {
    const auto* whole = std::get_if<IntegerRange>(&bounds);
    const RealRange within = whole != nullptr ? RealRange{static_cast<double>(whole->low), static_cast<double>(whole->high)}
                                              : std::get<RealRange>(bounds);
    if (!value.isText()) {
        if (whole != nullptr) return static_cast<double>(value.integer(whole->low, whole->high));
        if (value.number() < within.low || value.number() > within.high)
            value.fail(fmt::format("is not within {} and {}", within.low, within.high));
        return value.number();
    }
    const Amount named = amountOf(value, read);
    const auto parameter = std::ranges::find(read.entry.parameters, value.text(), &Parameter::name);
    const auto* integers = std::get_if<IntegerRange>(&parameter->domain);
    const auto* reals = std::get_if<RealRange>(&parameter->domain);
    const RealRange range =
        integers != nullptr ? RealRange{static_cast<double>(integers->low), static_cast<double>(integers->high)} : *reals;
    if ((whole != nullptr && integers == nullptr) || range.low < within.low || range.high > within.high)
        value.fail(fmt::format("{} must be a {}number within {} and {}", parameter->name, whole != nullptr ? "whole " : "",
                               within.low, within.high));
    return named;
}

} // namespace shadowbench::techniques
