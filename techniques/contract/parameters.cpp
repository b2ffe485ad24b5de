#include "techniques/contract/parameters.h"

#include "base/error.h"
#include "base/words.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace shadowbench::techniques {
namespace {

template <typename Number>
bool parses(const std::string& text, Number& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size();
}

bool allows(const Domain& domain, const std::string& value) {
    if (const auto* range = std::get_if<IntegerRange>(&domain)) {
        int number = 0;
        return parses(value, number) && number >= range->low && number <= range->high;
    }
    if (const auto* range = std::get_if<RealRange>(&domain)) {
        double number = 0;
        return parses(value, number) && std::isfinite(number) && number >= range->low && number <= range->high;
    }
    const auto& choices = std::get<OneOf>(domain).values;
    return std::find(choices.begin(), choices.end(), value) != choices.end();
}

/// One spelling per number: "01024" and "1024" are the same variant.
std::string normalised(const Domain& domain, const std::string& value) {
    if (std::holds_alternative<IntegerRange>(domain)) {
        int number = 0;
        parses(value, number);
        return fmt::format("{}", number);
    }
    if (std::holds_alternative<RealRange>(domain)) {
        double number = 0;
        parses(value, number);
        return fmt::format("{}", number);
    }
    return value;
}

std::vector<std::string> names(const std::vector<Parameter>& declared) {
    std::vector<std::string> result;
    for (const Parameter& parameter : declared) result.push_back(parameter.name);
    return result;
}

} // namespace

std::string describe(const Domain& domain) {
    if (const auto* range = std::get_if<IntegerRange>(&domain)) return fmt::format("{}…{}", range->low, range->high);
    if (const auto* range = std::get_if<RealRange>(&domain)) return fmt::format("{}…{}", range->low, range->high);
    return fmt::format("{}", fmt::join(std::get<OneOf>(domain).values, "|"));
}

const std::string& Parameters::text(std::string_view name) const {
    for (const auto& [key, value] : values_)
        if (key == name) return value;
    throw InternalError("a technique asks for the undeclared parameter " + std::string(name));
}

int Parameters::integer(std::string_view name) const {
    int value = 0;
    if (!parses(text(name), value)) throw InternalError("parameter " + std::string(name) + " is not an integer");
    return value;
}

double Parameters::real(std::string_view name) const {
    double value = 0;
    if (!parses(text(name), value)) throw InternalError("parameter " + std::string(name) + " is not a number");
    return value;
}

Parameters parseParameters(std::string_view assignments, const std::vector<Parameter>& declared,
                           const std::string& technique) {
    std::vector<std::pair<std::string, std::string>> values;
    for (const Parameter& parameter : declared)
        values.emplace_back(parameter.name, normalised(parameter.domain, parameter.defaultValue));

    std::vector<std::string> given;
    while (!assignments.empty()) {
        const std::string word(assignments.substr(0, assignments.find(',')));
        assignments.remove_prefix(std::min(assignments.size(), word.size() + 1));
        const std::size_t equals = word.find('=');
        const std::string name = word.substr(0, equals);
        const auto parameter =
            std::find_if(declared.begin(), declared.end(), [&](const Parameter& p) { return p.name == name; });
        if (parameter == declared.end())
            throw BadInput(fmt::format("technique {} has no parameter \"{}\"{}; it has: {}", technique, name,
                                       didYouMean(name, names(declared)),
                                       declared.empty() ? "none" : fmt::format("{}", fmt::join(names(declared), ", "))));
        if (equals == std::string::npos)
            throw BadInput(fmt::format("technique {}: parameter {} needs a value ({}={})", technique, name, name,
                                       describe(parameter->domain)));
        const std::string value = word.substr(equals + 1);
        if (!allows(parameter->domain, value))
            throw BadInput(fmt::format("technique {}: {}={} is not allowed; valid: {}", technique, name, value,
                                       describe(parameter->domain)));
        if (std::find(given.begin(), given.end(), name) != given.end())
            throw BadInput(fmt::format("technique {}: parameter {} is given twice", technique, name));
        given.push_back(name);
        values[static_cast<std::size_t>(parameter - declared.begin())].second = normalised(parameter->domain, value);
    }
    return Parameters(std::move(values));
}

std::string canonicalVariant(const std::string& id, const Parameters& parameters, const std::vector<Parameter>& declared) {
    std::vector<std::string> words;
    for (std::size_t i = 0; i < declared.size(); ++i) {
        const auto& [name, value] = parameters.all()[i];
        if (value != normalised(declared[i].domain, declared[i].defaultValue)) words.push_back(name + "=" + value);
    }
    return words.empty() ? id : fmt::format("{}:{}", id, fmt::join(words, ","));
}

} // namespace shadowbench::techniques
